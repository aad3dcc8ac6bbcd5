use crate::Error;
use crate::content::Content;
use crate::html::Html;

pub(super) fn section(_html: &mut Html, _content: &Content) -> Result<(), Error> {
    Ok(())
}
