//! What a page has set, in the words of a study file.

use std::collections::BTreeMap;

use eigentol::Study;
use eigentol_compiler::syntax::ast::Ast;
use eigentol_interpreter::{Interpreted, Setting, WantedError, with_setting};
use serde::{Deserialize, Serialize};

/// Settings of a page; where one is absent, that of the study which it began with holds.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Given {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) sweep: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) points: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) orders: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) samples: Option<usize>,
    pub(crate) set: Texts,
    pub(crate) start: Texts,
    pub(crate) tolerance: Texts,
}

type Texts = BTreeMap<String, String>;

impl Given {
    /// The study with these settings.
    pub(crate) fn apply(&self, mut study: Study<Interpreted>, of: &Ast) -> Result<Study<Interpreted>, WantedError> {
        let kinds = [(Setting::Set, &self.set), (Setting::Start, &self.start), (Setting::Tolerance, &self.tolerance)];
        for (setting, texts) in kinds {
            for (name, text) in texts {
                study = with_setting(study, of, setting, name, text)?;
            }
        }
        Ok(study)
    }

    /// A study file: the settings with which the page began, and over them these.
    pub(crate) fn study_file(&self, began: &toml::Table) -> Result<String, toml::ser::Error> {
        let mut all = began.clone();
        for (key, own) in toml::Table::try_from(self)? {
            match (all.get_mut(&key), own) {
                (Some(toml::Value::Table(old)), toml::Value::Table(own)) => old.extend(own),
                (_, toml::Value::Table(own)) if own.is_empty() => {}
                (_, own) => {
                    all.insert(key, own);
                }
            }
        }
        toml::to_string(&all)
    }
}

#[cfg(test)]
mod tests {
    use super::Given;

    #[test]
    fn a_study_file_keeps_what_the_page_does_not_set() {
        let began = "mechanism = \"a.mechanism\"\nseed = 7\n[set]\nl = \"1 m\"\nm = \"2 kg\"\n".parse().unwrap();
        let mut given = Given { samples: Some(100), ..Given::default() };
        given.set.insert("l".to_owned(), "2 m".to_owned());
        given.tolerance.insert("blade[..].mass".to_owned(), "1% \"odd\"".to_owned());
        let text = given.study_file(&began).unwrap();
        let back: toml::Table = text.parse().unwrap();
        assert_eq!(back["seed"].as_integer(), Some(7));
        assert_eq!(back["samples"].as_integer(), Some(100));
        assert_eq!((back["set"]["l"].as_str(), back["set"]["m"].as_str()), (Some("2 m"), Some("2 kg")));
        assert_eq!(back["tolerance"]["blade[..].mass"].as_str(), Some("1% \"odd\""));
        assert!(!back.contains_key("start"));
    }
}
