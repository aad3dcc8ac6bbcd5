//! XML as a tree of its own, with the files that it includes in their places.

use std::collections::BTreeMap;

use roxmltree::{Document, Node};

use super::Include;
use crate::error::{ImportError, Reason};
use crate::robot::SourcePosition;

/// Most levels of files that include each other.
const DEPTH: usize = 16;

/// An element.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) tag: String,
    pub(super) attributes: BTreeMap<String, String>,
    pub(super) children: Vec<Element>,
    /// Of an included file, the place of the `include`.
    pub(super) at: SourcePosition,
}

impl Element {
    pub(super) fn get(&self, attribute: &str) -> Option<&str> {
        self.attributes.get(attribute).map(|text| text.trim())
    }

    pub(super) fn named(&self, tag: &str) -> impl Iterator<Item = &Element> {
        self.children.iter().filter(move |child| child.tag == tag)
    }

    pub(super) fn mistake(&self, reason: Reason) -> ImportError {
        ImportError { mistakes: vec![self.at.mistake(reason)] }
    }

    /// A mistake in words of its own.
    pub(super) fn wrong(&self, message: impl Into<String>, help: impl Into<String>) -> ImportError {
        self.mistake(Reason::Model { message: message.into(), help: help.into() })
    }
}

pub(super) fn read(text: &str, include: Include<'_>) -> Result<Element, ImportError> {
    parsed(text, include, None, DEPTH)
}

fn parsed(
    text: &str,
    include: Include<'_>,
    within: Option<SourcePosition>,
    depth: usize,
) -> Result<Element, ImportError> {
    let document = Document::parse(text).map_err(|error| {
        let at = error.pos();
        let own = SourcePosition { line: at.row, column: at.col };
        ImportError { mistakes: vec![within.unwrap_or(own).mistake(Reason::Xml(error.to_string()))] }
    })?;
    element(&document, document.root_element(), include, within, depth)
}

fn element(
    document: &Document<'_>,
    node: Node<'_, '_>,
    include: Include<'_>,
    within: Option<SourcePosition>,
    depth: usize,
) -> Result<Element, ImportError> {
    let place = document.text_pos_at(node.range().start);
    let at = within.unwrap_or(SourcePosition { line: place.row, column: place.col });
    let mut children = Vec::new();
    for child in node.children().filter(Node::is_element) {
        let own = element(document, child, include, within, depth)?;
        if own.tag != "include" {
            children.push(own);
            continue;
        }
        let Some(file) = own.get("file") else {
            return Err(own.mistake(Reason::MissingAttribute { element: "include".to_owned(), attribute: "file" }));
        };
        if depth == 0 {
            return Err(own.wrong(format!("`{file}` is included too deeply"), "files cannot include each other"));
        }
        let bytes = include(file).map_err(|error| {
            own.wrong(format!("`{file}` cannot be read: {error}"), "it is looked for beside the file that is imported")
        })?;
        let text = String::from_utf8_lossy(&bytes);
        children.extend(parsed(&text, include, Some(own.at), depth - 1)?.children);
    }
    let attributes = node.attributes().map(|own| (own.name().to_owned(), own.value().to_owned()));
    Ok(Element { tag: node.tag_name().name().to_owned(), attributes: attributes.collect(), children, at })
}
