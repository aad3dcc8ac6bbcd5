//! HTML generation that escapes everything except constants of this crate, so that no outside text can become markup.

use std::fmt::Write as _;

/// Attributes of an element: constant names, arbitrary values.
pub(crate) type Attributes<'a> = &'a [(&'static str, &'a str)];

/// A growing piece of HTML.
#[derive(Default)]
pub(crate) struct Html {
    out: String,
}

impl Html {
    /// Writes an element and its content.
    pub(crate) fn element(&mut self, tag: &'static str, attributes: Attributes<'_>, inside: impl FnOnce(&mut Self)) {
        self.open(tag, attributes);
        inside(self);
        let _ = write!(self.out, "</{tag}>");
    }

    /// Writes an element that contains only text.
    pub(crate) fn leaf(&mut self, tag: &'static str, attributes: Attributes<'_>, text: &str) {
        self.element(tag, attributes, |x| x.text(text));
    }

    /// Writes a paragraph.
    pub(crate) fn paragraph(&mut self, text: &str) {
        self.leaf("p", &[], text);
        self.out.push('\n');
    }

    /// Writes an opening tag; void elements need nothing more.
    pub(crate) fn open(&mut self, tag: &'static str, attributes: Attributes<'_>) {
        let _ = write!(self.out, "<{tag}");
        for (name, value) in attributes {
            let _ = write!(self.out, " {name}=\"");
            self.text(value);
            self.out.push('"');
        }
        self.out.push('>');
    }

    /// Writes arbitrary text, escaped.
    pub(crate) fn text(&mut self, text: &str) {
        for character in text.chars() {
            match character {
                '&' => self.out.push_str("&amp;"),
                '<' => self.out.push_str("&lt;"),
                '>' => self.out.push_str("&gt;"),
                '"' => self.out.push_str("&quot;"),
                '\'' => self.out.push_str("&#39;"),
                '\0' => self.out.push('\u{fffd}'),
                other => self.out.push(other),
            }
        }
    }

    /// Writes constant markup of this crate.
    pub(crate) fn constant(&mut self, markup: &'static str) {
        self.out.push_str(markup);
    }

    /// Writes data for the scripts of the page. Inside a script element no HTML escape applies and `<` may end it, so
    /// `<` is written as a JSON escape.
    pub(crate) fn data(&mut self, kind: &str, json: &str) {
        self.open("script", &[("type", "application/json"), ("data-kind", kind)]);
        self.out.push_str(&json.replace('<', "\\u003c"));
        self.constant("</script>\n");
    }

    pub(crate) fn finish(self) -> String {
        self.out
    }
}

#[cfg(test)]
mod tests {
    use super::Html;

    #[test]
    fn text_stays_text() {
        let mut html = Html::default();
        html.leaf("p", &[("title", "a\" onclick='x'")], "</p><script>&\0");
        assert_eq!(html.finish(), "<p title=\"a&quot; onclick=&#39;x&#39;\">&lt;/p&gt;&lt;script&gt;&amp;\u{fffd}</p>");
    }

    #[test]
    fn data_cannot_end_their_script() {
        let mut html = Html::default();
        html.data("x", r#"["</script><!--"]"#);
        let text = html.finish();
        assert_eq!(text.matches('<').count(), 2, "{text}");
        assert!(text.contains(r#"["\u003c/script>\u003c!--"]"#));
    }
}
