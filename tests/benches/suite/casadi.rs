//! Functions that CasADi wrote as C, loaded at run time.

use std::ffi::c_int;
use std::hint::black_box;
use std::path::Path;

use libloading::{Library, Symbol};

use crate::work::Work;

/// `int f(const double** arg, double** res, long long* iw, double* w, int mem)`.
type Evaluate =
    unsafe extern "C" fn(*const *const f64, *const *mut f64, *mut i64, *mut f64, c_int) -> c_int;

/// A loaded function and its prepared inputs.
pub(crate) struct CasadiWork {
    evaluate: Evaluate,
    /// For every input one pointer per argument, into `_inputs`.
    arguments: Vec<Vec<*const f64>>,
    /// One pointer per result, into `outputs`.
    results: Vec<*mut f64>,
    outputs: Vec<Vec<f64>>,
    integers: Vec<i64>,
    reals: Vec<f64>,
    _inputs: Vec<Vec<Vec<f64>>>,
    _library: Library,
}

impl CasadiWork {
    /// Loads `name`; each of `inputs` has one array per argument.
    ///
    /// # Errors
    /// Where the library or the function is missing, or the arguments do not fit.
    pub(crate) fn load(
        library: &Path,
        name: &str,
        inputs: Vec<Vec<Vec<f64>>>,
    ) -> Result<Self, String> {
        let fail = |error: libloading::Error| error.to_string();
        // SAFETY: the library was compiled from C that CasADi generated: it runs nothing when loaded, its functions have
        // the signatures that CasADi documents, and it lives as long as the pointer taken from it.
        #[allow(unsafe_code)]
        unsafe {
            let library = Library::new(library).map_err(fail)?;
            let evaluate = *library.get::<Evaluate>(name.as_bytes()).map_err(fail)?;
            let dense = |suffix: &str, number: usize| -> Result<Vec<usize>, String> {
                type Sparsity = unsafe extern "C" fn(i64) -> *const i64;
                let symbol = format!("{name}_sparsity_{suffix}");
                let sparsity: Symbol<Sparsity> = library.get(symbol.as_bytes()).map_err(fail)?;
                // An array of rows, columns and more; these are all dense.
                Ok((0..number as i64)
                    .map(|k| sparsity(k))
                    .map(|s| (*s * *s.add(1)) as usize)
                    .collect())
            };
            let number = |suffix: &str| -> Result<usize, String> {
                let symbol = format!("{name}_n_{suffix}");
                let number: Symbol<unsafe extern "C" fn() -> i64> =
                    library.get(symbol.as_bytes()).map_err(fail)?;
                Ok(number() as usize)
            };
            let lengths = dense("in", number("in")?)?;
            let fits =
                |input: &Vec<Vec<f64>>| input.iter().map(Vec::len).collect::<Vec<_>>() == lengths;
            if !inputs.iter().all(fits) {
                return Err(format!("{name} takes arrays of lengths {lengths:?}"));
            }
            type Sizes = unsafe extern "C" fn(*mut i64, *mut i64, *mut i64, *mut i64) -> c_int;
            let work: Symbol<Sizes> = library
                .get(format!("{name}_work").as_bytes())
                .map_err(fail)?;
            let [mut arguments, mut results, mut integers, mut reals] = [0_i64; 4];
            work(&mut arguments, &mut results, &mut integers, &mut reals);
            let lengths = dense("out", number("out")?)?.into_iter();
            let mut outputs: Vec<Vec<f64>> = lengths.map(|length| vec![0.0; length]).collect();
            let pointers = |input: &Vec<Vec<f64>>| input.iter().map(|x| x.as_ptr()).collect();
            Ok(Self {
                evaluate,
                arguments: inputs.iter().map(pointers).collect(),
                results: outputs.iter_mut().map(|x| x.as_mut_ptr()).collect(),
                outputs,
                integers: vec![0; integers as usize + 1],
                reals: vec![0.0; reals as usize + 1],
                _inputs: inputs,
                _library: library,
            })
        }
    }
}

impl Work for CasadiWork {
    fn inputs(&self) -> usize {
        self.arguments.len()
    }

    fn evaluate(&mut self, input: usize) {
        // SAFETY: `load` checked the lengths of the arguments and took those of results and work space from the function;
        // the arrays behind the pointers live as long as `self` and are never moved.
        #[allow(unsafe_code)]
        unsafe {
            (self.evaluate)(
                black_box(self.arguments[input].as_ptr()),
                self.results.as_ptr(),
                self.integers.as_mut_ptr(),
                self.reals.as_mut_ptr(),
                0,
            );
        }
        black_box(&self.outputs);
    }

    fn results(&mut self, input: usize) -> Vec<Vec<f64>> {
        self.evaluate(input);
        self.outputs.clone()
    }
}
