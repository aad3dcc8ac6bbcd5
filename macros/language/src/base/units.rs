//! Unit names and their SI values: the user writes the units of the drawing, the compiler computes in SI.
//!
//! # Hz is an angular unit
//!
//! 1 Hz = 2 pi rad/s: in this field a frequency counts cycles of a rotation or a vibration. An inverse time without
//! that factor is written `1/s`.

use std::f64::consts::PI;

use super::dimension::Dimension;
use super::nearest::nearest;

/// A unit name with its meaning: a value in SI is the value in this unit times `scale`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedUnit {
    /// Dimension.
    pub dimension: Dimension,
    /// SI value of one unit.
    pub scale: f64,
}

/// Units that take decimal prefixes, each as a factor times a power of ten.
const PREFIXED: [(&str, Dimension, f64, i32); 10] = [
    ("m", Dimension::LENGTH, 1.0, 0),
    ("g", Dimension::MASS, 1.0, -3),
    ("s", Dimension::TIME, 1.0, 0),
    ("N", Dimension::FORCE, 1.0, 0),
    ("Pa", Dimension::PRESSURE, 1.0, 0),
    ("bar", Dimension::PRESSURE, 1.0, 5),
    ("J", Dimension::MOMENT, 1.0, 0),
    ("W", Dimension::POWER, 1.0, 0),
    // One cycle per second of a rotation or vibration, so that `50 Hz` can be given where rad/s are needed.
    ("Hz", Dimension::RATE, 2.0 * PI, 0),
    ("rad", Dimension::NONE, 1.0, 0),
];

/// Units without prefixes.
///
/// Pounds, inches and what follows from them are exact: NIST Special Publication 811, appendix B.
const PLAIN: [(&str, Dimension, f64); 18] = [
    ("deg", Dimension::NONE, PI / 180.0),
    ("rev", Dimension::NONE, 2.0 * PI),
    ("rpm", Dimension::RATE, 2.0 * PI / 60.0),
    ("rps", Dimension::RATE, 2.0 * PI),
    ("min", Dimension::TIME, 60.0),
    ("h", Dimension::TIME, 3600.0),
    ("t", Dimension::MASS, 1000.0),
    ("inch", Dimension::LENGTH, 0.0254),
    ("ft", Dimension::LENGTH, 0.3048),
    ("lb", Dimension::MASS, 0.453_592_37),
    ("oz", Dimension::MASS, 0.453_592_37 / 16.0),
    ("lbf", Dimension::FORCE, POUND_FORCE),
    ("kip", Dimension::FORCE, 4_448.221_615_260_5),
    ("kgf", Dimension::FORCE, 9.806_65),
    ("slug", Dimension::MASS, POUND_FORCE / 0.3048),
    ("mil", Dimension::LENGTH, 25.4e-6),
    ("psi", Dimension::PRESSURE, POUND_FORCE / 0.000_645_16),
    ("ksi", Dimension::PRESSURE, 4_448.221_615_260_5 / 0.000_645_16),
];

const POUND_FORCE: f64 = 4.448_221_615_260_5;

const PREFIXES: [(&str, i32); 11] = [
    ("", 0),
    ("p", -12),
    ("n", -9),
    ("u", -6),
    ("m", -3),
    ("c", -2),
    ("d", -1),
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
];

/// The unit called `name`.
pub fn find(name: &str) -> Option<NamedUnit> {
    let plain = PLAIN.iter().find(|entry| entry.0 == name);
    if let Some(&(_, dimension, scale)) = plain {
        return Some(NamedUnit { dimension, scale });
    }
    PREFIXES.iter().find_map(|(prefix, power)| {
        let base = name.strip_prefix(prefix)?;
        let &(_, dimension, factor, exponent) = PREFIXED.iter().find(|entry| entry.0 == base)?;
        Some(NamedUnit { dimension, scale: factor * power_of_ten(power + exponent) })
    })
}

/// The double nearest to the power of ten, which repeated multiplication misses.
fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}

/// Common spellings of units, and the symbol to write instead.
const WORDS: [(&str, &str); 66] = [
    ("metre", "m"),
    ("meter", "m"),
    ("millimetre", "mm"),
    ("millimeter", "mm"),
    ("centimetre", "cm"),
    ("centimeter", "cm"),
    ("kilometre", "km"),
    ("kilometer", "km"),
    ("in", "inch"),
    ("inches", "inch"),
    ("foot", "ft"),
    ("feet", "ft"),
    ("gram", "g"),
    ("kilogram", "kg"),
    ("kilo", "kg"),
    ("kgs", "kg"),
    ("tonne", "t"),
    ("ton", "t"),
    ("lbs", "lb"),
    ("pound", "lb"),
    ("lbm", "lb"),
    ("ounce", "oz"),
    ("slinch", "lbf*s^2/inch"),
    ("thou", "mil"),
    ("micron", "um"),
    ("kp", "kgf"),
    ("kilopond", "kgf"),
    ("poundforce", "lbf"),
    ("ftlb", "lbf*ft"),
    ("ftlbf", "lbf*ft"),
    ("lbft", "lbf*ft"),
    ("lbfft", "lbf*ft"),
    ("inlb", "lbf*inch"),
    ("inlbf", "lbf*inch"),
    ("lbin", "lbf*inch"),
    ("lbfin", "lbf*inch"),
    ("second", "s"),
    ("sec", "s"),
    ("millisecond", "ms"),
    ("minute", "min"),
    ("hour", "h"),
    ("hr", "h"),
    ("newton", "N"),
    ("kilonewton", "kN"),
    ("pascal", "Pa"),
    ("megapascal", "MPa"),
    ("joule", "J"),
    ("watt", "W"),
    ("kilowatt", "kW"),
    ("hertz", "Hz"),
    ("radian", "rad"),
    ("degree", "deg"),
    ("revolution", "rev"),
    ("turn", "rev"),
    ("rps", "Hz"),
    ("mps", "m/s"),
    ("kmh", "km/h"),
    ("kph", "km/h"),
    ("Nm", "N*m"),
    ("kNm", "kN*m"),
    ("mNm", "mN*m"),
    ("Nmm", "N*mm"),
    ("Nms", "N*m*s"),
    ("kgm", "kg*m"),
    ("kgm2", "kg*m^2"),
    ("mm2", "mm^2"),
];

/// Advice for words that mean a hundredth, which is not a unit.
pub fn per_cent(name: &str) -> Option<String> {
    let is_one = ["percent", "per", "pct", "procent", "percentage"].iter().any(|word| word.eq_ignore_ascii_case(name));
    is_one.then(|| "a tolerance in per cent is written `+/- 3%`; elsewhere write the number, `0.03`".to_string())
}

/// The intended unit if a power or a sign is spelt differently in this language: `m3`, `µm`, `N·m`.
pub fn respelt(name: &str) -> Option<String> {
    let plain = name.replace(['µ', 'μ'], "u").replace('·', "*");
    let text = plain
        .split('*')
        .map(|part| {
            let base = part.trim_end_matches(|sign: char| sign.is_ascii_digit());
            find(base)?;
            Some(match &part[base.len()..] {
                "" => base.to_string(),
                power => format!("{base}^{power}"),
            })
        })
        .collect::<Option<Vec<_>>>()?
        .join("*");
    (text != name).then_some(text)
}

/// The probable meaning of an unknown unit: the symbol for a word, in singular or plural, otherwise the nearest symbol.
pub fn suggestion(name: &str) -> Option<&'static str> {
    let name = &name.replace('_', "");
    let singular = name.strip_suffix('s').unwrap_or(name);
    let word = |name: &str| {
        let word = WORDS.iter().find(|word| word.0.eq_ignore_ascii_case(name));
        word.map(|word| word.1)
    };
    let plain = |name: &str| {
        let symbol = PLAIN.iter().find(|pair| pair.0.eq_ignore_ascii_case(name));
        symbol.map(|symbol| symbol.0)
    };
    [name, singular].into_iter().find_map(|name| word(name).or_else(|| plain(name))).or_else(|| nearest(name, names()))
}

/// Names to suggest for a misspelt unit, the most common first.
fn names() -> impl Iterator<Item = &'static str> {
    const PREFIXED_IN_USE: [&str; 22] = [
        "kg", "mm", "cm", "um", "km", "mg", "ms", "us", "kN", "mN", "MN", "kPa", "MPa", "GPa", "mJ", "kJ", "mW", "kW",
        "kHz", "mrad", "dm", "ns",
    ];
    let prefixed = PREFIXED.iter().map(|entry| entry.0);
    let plain = PLAIN.iter().map(|entry| entry.0);
    prefixed.chain(PREFIXED_IN_USE).chain(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(name: &str) -> f64 {
        find(name).unwrap().scale
    }

    #[test]
    fn prefixes() {
        assert_eq!(scale("kg"), 1.0);
        assert_eq!(scale("g"), 1e-3);
        assert_eq!(scale("mg"), 1e-6);
        assert_eq!(scale("ug"), 1e-9);
        assert_eq!(scale("mm"), 1e-3);
        assert_eq!(scale("GPa"), 1e9);
        assert_eq!(scale("mrad"), 1e-3);
    }

    #[test]
    fn names_win_over_prefixes() {
        assert_eq!(scale("min"), 60.0);
        assert_eq!(find("min").unwrap().dimension, Dimension::TIME);
        assert_eq!(scale("t"), 1000.0);
        assert_eq!(scale("ft"), 0.3048);
    }

    #[test]
    fn rotation() {
        assert_eq!(scale("rpm") * 60.0, 2.0 * PI);
        assert_eq!(scale("Hz"), 2.0 * PI);
        assert_eq!(scale("deg") * 180.0, PI);
    }

    #[test]
    fn pound_force_is_a_pound_in_standard_gravity() {
        assert!((scale("lbf") - scale("lb") * 9.80665).abs() < 1e-15);
        assert_eq!(scale("kgf"), 9.80665);
    }

    /// Against NIST Special Publication 811, appendix B.8, to the digits that it gives.
    #[test]
    fn customary_units() {
        for (name, dimension, published) in [
            ("psi", Dimension::PRESSURE, 6.894_757e3),
            ("ksi", Dimension::PRESSURE, 6.894_757e6),
            ("bar", Dimension::PRESSURE, 1e5),
            ("mbar", Dimension::PRESSURE, 1e2),
            ("slug", Dimension::MASS, 14.593_90),
            ("oz", Dimension::MASS, 2.834_952e-2),
            ("kip", Dimension::FORCE, 4.448_222e3),
            ("mil", Dimension::LENGTH, 2.54e-5),
        ] {
            let unit = find(name).unwrap();
            assert_eq!(unit.dimension, dimension, "{name}");
            assert!((unit.scale / published - 1.0).abs() < 3e-7, "{name}");
        }
    }

    #[test]
    fn words_stand_for_symbols() {
        for (name, symbol) in [
            ("metre", "m"),
            ("Seconds", "s"),
            ("Nm", "N*m"),
            ("kgg", "kg"),
            ("lbm", "lb"),
            ("PSI", "psi"),
            ("RPM", "rpm"),
            ("slugs", "slug"),
            ("ft_lb", "lbf*ft"),
        ] {
            assert_eq!(suggestion(name), Some(symbol));
        }
        assert_eq!(suggestion("celsius"), None);
        for (_, symbol) in WORDS {
            let parts = symbol.split(['*', '/', '^']);
            assert!(parts.filter(|part| *part != "2").all(|part| find(part).is_some()), "{symbol}");
        }
    }

    #[test]
    fn every_suggested_name_is_known() {
        for name in names() {
            assert!(find(name).is_some(), "{name}");
        }
        for name in ["kgg", "", "k", "kmin", "mkg", "Kg", "M"] {
            assert!(find(name).is_none(), "{name}");
        }
    }
}
