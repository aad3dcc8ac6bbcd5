//! Classes of defaults, written into the elements that they are for.

use std::collections::BTreeMap;

use super::element::Element;
use crate::error::ImportError;

/// By class, then by kind of element, the attributes.
type Classes = BTreeMap<String, BTreeMap<String, BTreeMap<String, String>>>;

const MAIN: &str = "main";

/// The tree, each of whose elements has all its attributes.
pub(super) fn written_out(mut root: Element) -> Result<Element, ImportError> {
    let mut classes = Classes::new();
    let tops: Vec<Element> = root.named("default").cloned().collect();
    let read = tops.iter().try_for_each(|top| class(top, None, &mut classes));
    let write = |root: &mut Element| {
        let own = root.children.iter_mut().filter(|child| child.tag != "default");
        own.into_iter().try_for_each(|child| write(child, MAIN, &classes))
    };
    read.and_then(|()| write(&mut root))?;
    Ok(root)
}

fn class(own: &Element, parent: Option<&str>, classes: &mut Classes) -> Result<(), ImportError> {
    let name = match (own.get("class"), parent) {
        (Some(name), _) => name.to_owned(),
        (None, None) => MAIN.to_owned(),
        (None, Some(_)) => return Err(own.wrong("a class of defaults has no name", "give it `class=\"..\"`")),
    };
    let mut all = parent.and_then(|parent| classes.get(parent)).cloned().unwrap_or_default();
    // Several files may each have their share of the first class.
    if let (None, Some(before)) = (parent, classes.get(&name)) {
        all.clone_from(before);
    }
    for child in own.children.iter().filter(|child| child.tag != "default") {
        all.entry(child.tag.clone()).or_default().extend(child.attributes.clone());
    }
    classes.insert(name.clone(), all);
    own.named("default").try_for_each(|child| class(child, Some(&name), classes))
}

/// Writes the defaults of a class, or of that which an element names, into it and what it contains.
fn write(own: &mut Element, inherited: &str, classes: &Classes) -> Result<(), ImportError> {
    let within = own.get("childclass").unwrap_or(inherited).to_owned();
    let class = own.get("class").unwrap_or(if own.tag == "body" { &within } else { inherited }).to_owned();
    let Some(defaults) = classes.get(&class).or_else(|| classes.get(MAIN).filter(|_| class == MAIN)) else {
        if class == MAIN {
            return own.children.iter_mut().try_for_each(|child| write(child, &within, classes));
        }
        return Err(own.wrong(format!("there is no class `{class}`"), "declare it in `default`"));
    };
    let kind = if own.tag == "freejoint" { "" } else { &*own.tag };
    for (name, value) in defaults.get(kind).into_iter().flatten() {
        own.attributes.entry(name.clone()).or_insert_with(|| value.clone());
    }
    own.children.iter_mut().try_for_each(|child| write(child, &within, classes))
}
