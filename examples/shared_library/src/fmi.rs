//! FMI 3.0, model exchange and co-simulation: parameters and inputs in their declared units, outputs that are the answers, and
//! directional and adjoint derivatives. There is no state: time does not matter.

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::fmt::Write as _;
use std::ptr;
use std::slice;

use eigentol::Unit;

use crate::answers::{Answers, Variable, answers, names, variables};

/// What the importer must show to get an instance.
const TOKEN: &str = "eigentol-rotor-1";

type Status = c_int;
const OK: Status = 0;
const DISCARD: Status = 2;
const ERROR: Status = 3;

type Log = Option<unsafe extern "C" fn(*mut c_void, Status, *const c_char, *const c_char)>;

/// A machine at a design. Value references: 0 is the time, then variables, then answers.
pub struct Instance {
    variables: Vec<Variable>,
    units: Vec<Unit>,
    x: Vec<f64>,
    time: f64,
    answers: Option<Result<Answers, String>>,
    log: Log,
    environment: *mut c_void,
}

impl Instance {
    fn new(log: Log, environment: *mut c_void) -> Self {
        let variables = variables();
        let x = variables.iter().map(|variable| variable.start).collect();
        let units = names().into_iter().map(|(_, unit)| unit).collect();
        Self { variables, units, x, time: 0.0, answers: None, log, environment }
    }

    fn answers(&mut self) -> Result<&Answers, &str> {
        let x = &self.x;
        self.answers.get_or_insert_with(|| answers(x)).as_ref().map_err(|message| &**message)
    }

    fn get(&mut self, reference: u32) -> Result<f64, String> {
        let place = reference as usize;
        let count = self.variables.len();
        match place {
            0 => Ok(self.time),
            _ if place <= count => Ok(self.variables[place - 1].unit.from_si(self.x[place - 1])),
            _ if place <= count + self.units.len() => {
                let value = self.answers()?.values[place - 1 - count];
                Ok(self.units[place - 1 - count].from_si(value))
            }
            _ => Err(format!("there is no variable {reference}")),
        }
    }

    fn set(&mut self, reference: u32, value: f64) -> Result<(), String> {
        match reference as usize {
            0 => self.time = value,
            place if place <= self.variables.len() => {
                self.x[place - 1] = self.variables[place - 1].unit.scale * value;
                self.answers = None;
            }
            _ => return Err(format!("variable {reference} cannot be set")),
        }
        Ok(())
    }

    /// The derivative of an answer by a variable, in their units.
    fn slope(&mut self, unknown: u32, known: u32) -> Result<f64, String> {
        let count = self.variables.len();
        let answer = (unknown as usize).checked_sub(count + 1).filter(|k| *k < self.units.len());
        let variable = (known as usize).checked_sub(1).filter(|k| *k < count);
        let (Some(answer), Some(variable)) = (answer, variable) else {
            return Err(format!("there is no derivative of {unknown} by {known}"));
        };
        let slope = self.answers()?.rows[answer][variable];
        Ok(slope * self.variables[variable].unit.scale / self.units[answer].scale)
    }

    /// Tells the importer why not.
    fn told(&self, outcome: Result<(), String>) -> Status {
        let Err(message) = outcome else { return OK };
        if let (Some(log), Ok(text)) = (self.log, CString::new(message)) {
            unsafe { log(self.environment, DISCARD, c"logStatusDiscard".as_ptr(), text.as_ptr()) };
        }
        DISCARD
    }
}

/// # Safety
/// As FMI calls: a pointer from an instantiation that is not freed.
unsafe fn instance<'a>(pointer: *mut c_void) -> Option<&'a mut Instance> {
    unsafe { pointer.cast::<Instance>().as_mut() }
}

unsafe fn all<'a, T>(pointer: *const T, count: usize) -> &'a [T] {
    if count == 0 { &[] } else { unsafe { slice::from_raw_parts(pointer, count) } }
}

unsafe fn room<'a, T>(pointer: *mut T, count: usize) -> &'a mut [T] {
    if count == 0 { &mut [] } else { unsafe { slice::from_raw_parts_mut(pointer, count) } }
}

#[unsafe(no_mangle)]
extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

unsafe fn instantiated(token: *const c_char, log: Log, environment: *mut c_void) -> *mut c_void {
    let right = !token.is_null() && unsafe { CStr::from_ptr(token) }.to_bytes() == TOKEN.as_bytes();
    if right { Box::into_raw(Box::new(Instance::new(log, environment))).cast() } else { ptr::null_mut() }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3InstantiateModelExchange(
    _name: *const c_char,
    token: *const c_char,
    _resources: *const c_char,
    _visible: bool,
    _logging: bool,
    environment: *mut c_void,
    log: Log,
) -> *mut c_void {
    unsafe { instantiated(token, log, environment) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3InstantiateCoSimulation(
    _name: *const c_char,
    token: *const c_char,
    _resources: *const c_char,
    _visible: bool,
    _logging: bool,
    _event_mode: bool,
    _early_return: bool,
    _required: *const u32,
    _required_count: usize,
    environment: *mut c_void,
    log: Log,
    _update: *const c_void,
) -> *mut c_void {
    unsafe { instantiated(token, log, environment) }
}

#[unsafe(no_mangle)]
extern "C" fn fmi3InstantiateScheduledExecution() -> *mut c_void {
    ptr::null_mut()
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3FreeInstance(pointer: *mut c_void) {
    if !pointer.is_null() {
        drop(unsafe { Box::from_raw(pointer.cast::<Instance>()) });
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3Reset(pointer: *mut c_void) -> Status {
    let Some(own) = (unsafe { instance(pointer) }) else { return ERROR };
    *own = Instance::new(own.log, own.environment);
    OK
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3GetFloat64(
    pointer: *mut c_void,
    references: *const u32,
    count: usize,
    values: *mut f64,
    value_count: usize,
) -> Status {
    let Some(own) = (unsafe { instance(pointer) }) else { return ERROR };
    let (references, values) = unsafe { (all(references, count), room(values, value_count)) };
    let mut outcome = Ok(());
    for (reference, value) in references.iter().zip(values) {
        match own.get(*reference) {
            Ok(found) => *value = found,
            Err(message) => outcome = Err(message),
        }
    }
    own.told(outcome)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3SetFloat64(
    pointer: *mut c_void,
    references: *const u32,
    count: usize,
    values: *const f64,
    value_count: usize,
) -> Status {
    let Some(own) = (unsafe { instance(pointer) }) else { return ERROR };
    let mut pairs = unsafe { all(references, count).iter().zip(all(values, value_count)) };
    let outcome = pairs.try_for_each(|(reference, value)| own.set(*reference, *value));
    own.told(outcome)
}

/// `sensitivity = slopes * seed`, or with the transposed slopes.
unsafe fn derivative(
    pointer: *mut c_void,
    [unknowns, knowns]: [&[u32]; 2],
    seed: &[f64],
    sensitivity: &mut [f64],
    transposed: bool,
) -> Status {
    let Some(own) = (unsafe { instance(pointer) }) else { return ERROR };
    sensitivity.fill(0.0);
    let mut outcome = Ok(());
    for (i, &unknown) in unknowns.iter().enumerate() {
        for (j, &known) in knowns.iter().enumerate() {
            match own.slope(unknown, known) {
                Ok(slope) if transposed => sensitivity[j] += slope * seed[i],
                Ok(slope) => sensitivity[i] += slope * seed[j],
                Err(message) => outcome = Err(message),
            }
        }
    }
    own.told(outcome)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3GetDirectionalDerivative(
    pointer: *mut c_void,
    unknowns: *const u32,
    unknown_count: usize,
    knowns: *const u32,
    known_count: usize,
    seed: *const f64,
    seed_count: usize,
    sensitivity: *mut f64,
    sensitivity_count: usize,
) -> Status {
    if seed_count != known_count || sensitivity_count != unknown_count {
        return ERROR;
    }
    unsafe {
        let references = [all(unknowns, unknown_count), all(knowns, known_count)];
        derivative(pointer, references, all(seed, seed_count), room(sensitivity, sensitivity_count), false)
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3GetAdjointDerivative(
    pointer: *mut c_void,
    unknowns: *const u32,
    unknown_count: usize,
    knowns: *const u32,
    known_count: usize,
    seed: *const f64,
    seed_count: usize,
    sensitivity: *mut f64,
    sensitivity_count: usize,
) -> Status {
    if seed_count != unknown_count || sensitivity_count != known_count {
        return ERROR;
    }
    unsafe {
        let references = [all(unknowns, unknown_count), all(knowns, known_count)];
        derivative(pointer, references, all(seed, seed_count), room(sensitivity, sensitivity_count), true)
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3SetTime(pointer: *mut c_void, time: f64) -> Status {
    let Some(own) = (unsafe { instance(pointer) }) else { return ERROR };
    own.time = time;
    OK
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3DoStep(
    pointer: *mut c_void,
    time: f64,
    step: f64,
    _no_return_before: bool,
    event: *mut bool,
    terminate: *mut bool,
    early: *mut bool,
    last: *mut f64,
) -> Status {
    let Some(own) = (unsafe { instance(pointer) }) else { return ERROR };
    own.time = time + step;
    unsafe {
        for flag in [event, terminate, early] {
            if !flag.is_null() {
                *flag = false;
            }
        }
        if !last.is_null() {
            *last = own.time;
        }
    }
    OK
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3UpdateDiscreteStates(
    _: *mut c_void,
    again: *mut bool,
    terminate: *mut bool,
    nominals: *mut bool,
    values: *mut bool,
    defined: *mut bool,
    next: *mut f64,
) -> Status {
    unsafe {
        for flag in [again, terminate, nominals, values, defined] {
            if !flag.is_null() {
                *flag = false;
            }
        }
        if !next.is_null() {
            *next = 0.0;
        }
    }
    OK
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3CompletedIntegratorStep(
    _: *mut c_void,
    _no_set_before: bool,
    event: *mut bool,
    terminate: *mut bool,
) -> Status {
    unsafe {
        for flag in [event, terminate] {
            if !flag.is_null() {
                *flag = false;
            }
        }
    }
    OK
}

unsafe fn none(count: *mut usize) -> Status {
    if !count.is_null() {
        unsafe { *count = 0 };
    }
    OK
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3GetNumberOfEventIndicators(_: *mut c_void, count: *mut usize) -> Status {
    unsafe { none(count) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn fmi3GetNumberOfContinuousStates(_: *mut c_void, count: *mut usize) -> Status {
    unsafe { none(count) }
}

/// Functions of one answer, which look at none of their arguments.
macro_rules! always {
    ($status:expr; $($name:ident)*) => {$(
        #[unsafe(no_mangle)]
        extern "C" fn $name() -> Status {
            $status
        }
    )*};
}

// Changes of mode, and arrays of states, of which there are none.
always! { OK;
    fmi3SetDebugLogging fmi3EnterInitializationMode fmi3ExitInitializationMode fmi3EnterEventMode fmi3Terminate
    fmi3EnterContinuousTimeMode fmi3EnterStepMode fmi3SetContinuousStates fmi3GetContinuousStates fmi3GetEventIndicators
    fmi3GetContinuousStateDerivatives fmi3GetNominalsOfContinuousStates fmi3EvaluateDiscreteStates
}

// Types and capabilities that the description does not promise.
always! { ERROR;
    fmi3GetFloat32 fmi3GetInt8 fmi3GetUInt8 fmi3GetInt16 fmi3GetUInt16 fmi3GetInt32 fmi3GetUInt32 fmi3GetInt64 fmi3GetUInt64
    fmi3GetBoolean fmi3GetString fmi3GetBinary fmi3GetClock fmi3SetFloat32 fmi3SetInt8 fmi3SetUInt8 fmi3SetInt16 fmi3SetUInt16
    fmi3SetInt32 fmi3SetUInt32 fmi3SetInt64 fmi3SetUInt64 fmi3SetBoolean fmi3SetString fmi3SetBinary fmi3SetClock
    fmi3GetNumberOfVariableDependencies fmi3GetVariableDependencies fmi3GetFMUState fmi3SetFMUState fmi3FreeFMUState
    fmi3SerializedFMUStateSize fmi3SerializeFMUState fmi3DeserializeFMUState fmi3EnterConfigurationMode
    fmi3ExitConfigurationMode fmi3GetIntervalDecimal fmi3GetIntervalFraction fmi3GetShiftDecimal fmi3GetShiftFraction
    fmi3SetIntervalDecimal fmi3SetIntervalFraction fmi3SetShiftDecimal fmi3SetShiftFraction fmi3GetOutputDerivatives
    fmi3ActivateModelPartition
}

/// `modelDescription.xml`.
#[must_use]
pub fn description() -> String {
    let (variables, names) = (variables(), names());
    let mut units: Vec<String> = variables.iter().map(|own| own.unit.symbol.to_string()).collect();
    units.extend(names.iter().map(|(_, unit)| unit.symbol.to_string()));
    units.sort();
    units.dedup();
    units.retain(|unit| !unit.is_empty());
    let unit = |unit: &Unit| match &*unit.symbol {
        "" => String::new(),
        symbol => format!(" unit=\"{}\"", escaped(symbol)),
    };
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"3.0\" modelName=\"rotor\" \
         instantiationToken=\"{TOKEN}\" generationTool=\"eigentol\">\n\
         <ModelExchange modelIdentifier=\"rotor\" providesDirectionalDerivatives=\"true\" providesAdjointDerivatives=\"true\"/>\n\
         <CoSimulation modelIdentifier=\"rotor\" canHandleVariableCommunicationStepSize=\"true\" \
         providesDirectionalDerivatives=\"true\" providesAdjointDerivatives=\"true\"/>\n<UnitDefinitions>\n"
    );
    for symbol in &units {
        let _ = writeln!(text, "<Unit name=\"{}\"/>", escaped(symbol));
    }
    text.push_str(
        "</UnitDefinitions>\n<DefaultExperiment startTime=\"0\" stopTime=\"1\" stepSize=\"0.1\"/>\n<ModelVariables>\n",
    );
    text.push_str(
        "<Float64 name=\"time\" valueReference=\"0\" causality=\"independent\" variability=\"continuous\"/>\n",
    );
    for (k, own) in variables.iter().enumerate() {
        let kind = if own.is_input {
            "causality=\"input\" variability=\"continuous\""
        } else {
            "causality=\"parameter\" variability=\"tunable\""
        };
        let (name, start) = (escaped(&own.name), own.unit.from_si(own.start));
        let _ = writeln!(
            text,
            "<Float64 name=\"{name}\" valueReference=\"{}\" {kind} start=\"{start:?}\"{}/>",
            k + 1,
            unit(&own.unit)
        );
    }
    let first = variables.len() + 1;
    for (k, (name, own)) in names.iter().enumerate() {
        let _ = writeln!(
            text,
            "<Float64 name=\"{}\" valueReference=\"{}\" causality=\"output\" variability=\"continuous\" initial=\"calculated\"{}/>",
            escaped(name),
            first + k,
            unit(own)
        );
    }
    text.push_str("</ModelVariables>\n<ModelStructure>\n");
    for word in ["Output", "InitialUnknown"] {
        for k in 0..names.len() {
            let _ = writeln!(text, "<{word} valueReference=\"{}\"/>", first + k);
        }
    }
    text.push_str("</ModelStructure>\n</fmiModelDescription>\n");
    text
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
