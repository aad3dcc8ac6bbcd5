//! Matrices that Abaqus and CalculiX write as `.mtx`: `*MATRIX OUTPUT` and `*SUBSTRUCTURE MATRIX OUTPUT` (Abaqus Keywords
//! Guide, `*MATRIX INPUT` and `*USER ELEMENT`; CalculiX, `writesubmatrix.f`).

use eigentol_compiler::matrix_market::{MOST_ROWS, Mistake, Word, end, lines};

use super::matrix::{Entry, Label, Matrix, Named, Rows, Wanted, completed, direction};

/// A keyword without spaces, in capitals, and the lines below it.
struct Section<'t> {
    keyword: String,
    head: Word<'t>,
    lines: Vec<Word<'t>>,
}

fn is_comment(line: &Word<'_>) -> bool {
    line.text.trim_start().starts_with("**")
}

fn sections(text: &str) -> Vec<Section<'_>> {
    let top = Word { line: 1, column: 1, text: "" };
    let mut all = vec![Section { keyword: String::new(), head: top, lines: Vec::new() }];
    for line in lines(text) {
        if line.text.trim_start().starts_with('*') && !is_comment(&line) {
            let keyword: String = line.text.chars().filter(|c| !c.is_whitespace()).collect();
            all.push(Section { keyword: keyword.to_ascii_uppercase(), head: line, lines: Vec::new() });
        } else if let Some(section) = all.last_mut() {
            section.lines.push(line);
        }
    }
    all
}

impl<'t> Section<'t> {
    fn is(&self, keyword: &str) -> bool {
        self.keyword.starts_with(keyword)
    }

    /// The words of the lines that are no comments.
    fn data(&self) -> impl Iterator<Item = Vec<Word<'t>>> {
        self.lines.iter().filter(|line| !is_comment(line)).map(|line| line.words()).filter(|words| !words.is_empty())
    }
}

pub(super) fn is_it(text: &str) -> bool {
    let all = sections(text);
    let mut data = all.iter().flat_map(Section::data);
    all.iter().any(|section| section.is("*USERELEMENT") || section.is("*MATRIX"))
        || data
            .next()
            .is_some_and(|words| [3, 5].contains(&words.len()) && words.iter().all(|word| word.number().is_ok()))
}

pub(super) fn read(text: &str, wanted: Wanted<'_>) -> Result<Matrix, Mistake> {
    let all = sections(text);
    let mut elements = all.iter().filter(|section| section.is("*USERELEMENT"));
    match (elements.next(), elements.next()) {
        (None, _) => sparse(text),
        (Some(element), None) => wanted.among(substructure(element, &all)?),
        (_, Some(second)) => Err(second.head.mistake("a second element: give a file with one substructure")),
    }
}

/// Lines of `node, direction, node, direction, value`, or of `row, column, value`.
pub(super) fn sparse(text: &str) -> Result<Matrix, Mistake> {
    let all = sections(text);
    let odd = |section: &&Section<'_>| !section.is("*MATRIX") || section.keyword.contains("SCALEFACTOR");
    if let Some(section) = all.iter().skip(1).find(odd).or(all.get(2)) {
        return Err(section.head.mistake("this keyword is not read: give a file with one matrix as it is"));
    }
    let mut rows = Rows::default();
    let (mut entries, mut order, mut length) = (Vec::new(), 0, 0);
    for words in all.iter().flat_map(Section::data) {
        if length > 0 && length != words.len() {
            return Err(words[0].mistake(format!("a line of {} words, where others have {length}", words.len())));
        }
        length = words.len();
        let (row, column, value) = match words[..] {
            [node, toward, other, across, value] => (rows.row(node, toward)?, rows.row(other, across)?, value),
            [row, column, value] => (row.index("row", MOST_ROWS)?, column.index("column", MOST_ROWS)?, value),
            _ => {
                return Err(
                    words[0].mistake("a line has node, direction, node, direction, value, or row, column, value")
                );
            }
        };
        order = order.max(row + 1).max(column + 1);
        entries.push((row, column, value.number()?));
    }
    let entries = completed(entries);
    match length {
        0 => Err(end(text, "the file has no entries")),
        5 => Ok(rows.matrix(entries)),
        _ => Ok(Matrix { order, labels: None, entries }),
    }
}

/// The lower triangles of the matrices of one element.
fn substructure(element: &Section<'_>, all: &[Section<'_>]) -> Result<Vec<Named>, Mistake> {
    // The nodes are in the comments after a certain one.
    let comments = element.lines.iter().skip_while(|line| !line.text.to_ascii_uppercase().contains("ELEMENT NODES"));
    let mut nodes: Vec<i64> = Vec::new();
    for word in comments.skip(1).take_while(|line| is_comment(line)).flat_map(|line| line.words()) {
        let number = word.text.trim_start_matches('*');
        if !number.is_empty() {
            nodes.push(Word { text: number, ..word }.whole("node")?);
        }
    }
    let labels = labels(&nodes, element)?;
    let order = labels.len();
    let mut matrices = Vec::new();
    for section in all.iter().filter(|section| section.is("*MATRIX,") && !section.keyword.contains("UNSYMM")) {
        let name = section.keyword.split(',').find_map(|one| one.strip_prefix("TYPE=")).unwrap_or_default();
        let values: Vec<Word<'_>> = section.data().flatten().collect();
        let expected = order * (order + 1) / 2;
        if values.len() != expected {
            let message =
                format!("the lower triangle of {order} rows has {expected} entries, but {} follow", values.len());
            return Err(section.head.mistake(message));
        }
        let places = (0..order).flat_map(|row| (0..=row).map(move |column| (row, column)));
        let entries = places.zip(values).map(|((row, column), value)| Ok((row, column, value.number()?)));
        let entries = completed(entries.collect::<Result<Vec<Entry>, Mistake>>()?);
        matrices.push((name.to_owned(), Ok(Matrix { order, labels: Some(labels.clone()), entries })));
    }
    Ok(matrices)
}

/// What the rows are: the first line has the directions at the first node and those after it, others begin with the position of
/// the node from which on theirs hold.
fn labels(nodes: &[i64], element: &Section<'_>) -> Result<Vec<Label>, Mistake> {
    let mut at = vec![Vec::new(); nodes.len()];
    for (k, line) in element.data().enumerate() {
        let position = if k == 0 { 0 } else { line[0].index("position of a node", nodes.len())? };
        let list = line.iter().skip(k.min(1)).map(|word| direction(*word)).collect::<Result<Vec<u8>, Mistake>>()?;
        if let Some(slot) = at.get_mut(position) {
            *slot = list;
        }
    }
    let mut now = &Vec::new();
    let mut all = Vec::new();
    for (node, change) in nodes.iter().zip(&at) {
        now = if change.is_empty() { now } else { change };
        all.extend(now.iter().map(|direction| (*node, *direction)));
    }
    if (1..=MOST_ROWS).contains(&all.len()) {
        return Ok(all);
    }
    let message = "the rows of the element are not said: nodes follow `** ELEMENT NODES`, and then their directions";
    Err(element.head.mistake(if all.is_empty() { message } else { "the element has too many rows" }))
}
