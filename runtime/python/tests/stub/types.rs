//! Python types of Rust types.

use std::collections::BTreeMap;

use syn::{GenericArgument, PathArguments, PathSegment, Type};

use super::source::{Source, docs};

/// Before the Python type in the documentation of an alias.
const MARK: &str = "In Python ";

/// Arrays by the Rust type of their numbers.
pub(crate) const ARRAYS: [(&str, &str, &str); 4] = [
    ("f64", "Real", "np.float64"),
    ("Complex", "Complex", "np.complex128"),
    ("bool", "Flags", "np.bool_"),
    ("i64", "Whole", "np.int64"),
];

pub(crate) struct Types {
    classes: BTreeMap<String, String>,
    aliases: BTreeMap<String, Alias>,
}

struct Alias {
    /// In Python, where the documentation says it.
    python: Option<String>,
    rust: Type,
}

impl Types {
    /// With the names of classes, in Python by those in Rust.
    pub(crate) fn new(source: &Source, classes: BTreeMap<String, String>) -> Self {
        let alias = |item_type: &syn::ItemType| {
            let python = python(&docs(&item_type.attrs));
            let rust = (*item_type.ty).clone();
            (item_type.ident.to_string(), Alias { python, rust })
        };
        Self { classes, aliases: source.aliases().map(alias).collect() }
    }

    /// The Python type of an argument, which may be more than what the function gets.
    pub(crate) fn argument(&self, own: &Type) -> String {
        self.of(own, true)
    }

    pub(crate) fn returned(&self, own: &Type) -> String {
        self.of(own, false)
    }

    fn of(&self, own: &Type, argument: bool) -> String {
        match own {
            Type::Reference(reference) => self.of(&reference.elem, argument),
            Type::Tuple(tuple) if tuple.elems.is_empty() => "None".to_owned(),
            Type::Tuple(tuple) => {
                let each = tuple.elems.iter().map(|elem| self.of(elem, argument));
                format!("tuple[{}]", each.collect::<Vec<_>>().join(", "))
            }
            Type::Path(path) => {
                let last = path.path.segments.last().expect("a path has a name");
                self.named(last, argument)
            }
            _ => panic!("no Python type is known for {own:?}"),
        }
    }

    fn named(&self, path_segment: &PathSegment, argument: bool) -> String {
        let name = path_segment.ident.to_string();
        let inner: Vec<Type> = arguments(path_segment);
        let of = |k: usize| self.of(&inner[k], argument);
        match (name.as_str(), argument) {
            ("PyResult" | "Bound" | "Py" | "PyRef", _) => of(0),
            ("Option", _) => format!("{} | None", of(0)),
            ("Vec", true) => format!("Sequence[{}]", of(0)),
            ("Vec", false) => format!("list[{}]", of(0)),
            ("BTreeMap", true) => format!("Mapping[{}, {}]", of(0), of(1)),
            ("BTreeMap", false) => format!("dict[{}, {}]", of(0), of(1)),
            ("f64", _) => "float".to_owned(),
            ("usize" | "u64" | "i64", _) => "int".to_owned(),
            ("bool", _) => "bool".to_owned(),
            ("str" | "String", _) => "str".to_owned(),
            ("PathBuf", _) => "str | PathLike[str]".to_owned(),
            ("Complex", _) => "complex".to_owned(),
            ("Array1" | "Array2" | "Array3" | "PyArrayDyn", _) => array(inner.first()),
            ("PyAny", _) => "Any".to_owned(),
            ("PyDict", _) => "dict[str, Any]".to_owned(),
            ("PyTuple", _) => "tuple[Any, ...]".to_owned(),
            ("Self", _) => "Self".to_owned(),
            _ => self.own(&name, argument),
        }
    }

    fn own(&self, name: &str, argument: bool) -> String {
        if let Some(class) = self.classes.get(name) {
            return class.clone();
        }
        match self.aliases.get(name) {
            Some(Alias { python: Some(python), .. }) if is_name(python) => python.clone(),
            Some(Alias { python: Some(_), .. }) => name.to_owned(),
            Some(alias) => self.of(&alias.rust, argument),
            None => panic!("no Python type is known for `{name}`"),
        }
    }
}

/// The Python type that a documentation names.
pub(crate) fn python(docs: &[String]) -> Option<String> {
    let text = docs.join(" ");
    let (_, rest) = text.split_once(MARK)?;
    Some(rest.split('`').nth(1)?.to_owned())
}

/// Whether it is nothing but a name, which needs no other.
pub(crate) fn is_name(python: &str) -> bool {
    python.chars().all(char::is_alphanumeric)
}

fn arguments(path_segment: &PathSegment) -> Vec<Type> {
    let PathArguments::AngleBracketed(list) = &path_segment.arguments else {
        return Vec::new();
    };
    let types = list.args.iter().filter_map(|arg| match arg {
        GenericArgument::Type(own) => Some(own.clone()),
        _ => None,
    });
    types.collect()
}

fn array(of: Option<&Type>) -> String {
    let name = match of {
        Some(Type::Path(path)) => path.path.segments.last().map(|segment| segment.ident.to_string()),
        _ => None,
    };
    let name = name.unwrap_or_else(|| "f64".to_owned());
    let array = ARRAYS.iter().find(|(rust, ..)| *rust == name);
    let (_, python, _) = array.unwrap_or_else(|| panic!("arrays of `{name}`"));
    (*python).to_owned()
}
