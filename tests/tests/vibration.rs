//! Forced vibration of declared machines: closed forms, bands against designs solved anew.

mod vibration {
    mod bands;
    mod closed_forms;
    mod exceedance;
    mod requirements;
    mod shares;
}
