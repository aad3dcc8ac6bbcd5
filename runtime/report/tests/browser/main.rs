//! Reports in a real headless browser. The tests print a message if there is none.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod chrome;

use std::fs;
use std::path::{Path, PathBuf};

use eigentol::{InDeclaredUnit, Study};
use eigentol_interpreter::Interpreted;
use eigentol_report::Report;
use serde_json::json;

use crate::chrome::Chrome;

fn declaration(name: &str) -> String {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let path = examples.join(format!("{name}.mechanism"));
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The rotor with everything that a report can contain.
fn rotor() -> Report<Interpreted> {
    let text = declaration("jeffcott_rotor");
    let mechanism = Interpreted::from_text(&text).expect("an example compiles");
    let study = Study::new(mechanism);
    let speed = study.find_input("speed").expect("it has a speed");
    let study = study.input(speed, InDeclaredUnit(3000.0));
    let values: Vec<_> = (0..=40).map(|k| InDeclaredUnit(100.0 * f64::from(k))).collect();
    Report::new(&study)
        .title("A rotor that leans to one side")
        .declaration(text)
        .samples(2000)
        .seed(7)
        .sweep(speed, &values)
        .orders(&[1.0])
}

fn save(report: &Report<Interpreted>, name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.html"));
    report.save(&path).expect("a report is written");
    path
}

/// A browser showing the report of the rotor; if there is no browser, `None` and a message.
fn opened(name: &str) -> Option<Chrome> {
    let file = save(&rotor(), name);
    let Some(mut chrome) = Chrome::start(name) else {
        println!("skipped, reports are not seen in a browser: there is no Chromium");
        return None;
    };
    chrome.open(&file);
    chrome.evaluate("document.querySelectorAll('details').forEach((own) => { own.open = true; })");
    Some(chrome)
}

/// The centre of an element on the screen, after scrolling to it.
fn middle(chrome: &mut Chrome, element: &str) -> [f64; 2] {
    chrome.evaluate(&format!("{element}.scrollIntoView({{ block: 'center' }})"));
    ["left + box.width / 2", "top + box.height / 2"].map(|of| {
        chrome.number(&format!("(() => {{ const box = {element}.getBoundingClientRect(); return box.{of}; }})()"))
    })
}

/// Selects the chart with this title.
fn chart(title: &str) -> String {
    format!("[...document.querySelectorAll('figure')].find((own) => own.querySelector('h3').textContent === '{title}')")
}

#[test]
fn the_page_is_drawn_without_a_complaint_and_loads_nothing() {
    let Some(mut chrome) = opened("drawn") else {
        return;
    };
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("drawn.html");
    assert!(fs::metadata(&file).unwrap().len() < 3_000_000);
    assert_eq!(chrome.complaints, Vec::<String>::new());
    assert_eq!(chrome.requests.len(), 1, "{:?}", chrome.requests);
    let load = "performance.getEntriesByType('navigation')[0].loadEventEnd";
    println!("the report of the rotor is loaded and drawn in {:.0} ms", chrome.number(load));
    let curves = format!("{}.querySelectorAll('g.curve').length", chart("Campbell diagram"));
    assert!(chrome.number(&curves) >= 4.0);
    let broken = "[...document.querySelectorAll('svg *')].filter((own) => \
        [...own.attributes].some(({ value }) => /NaN|Infinity|undefined/.test(value))).length";
    assert_eq!(chrome.evaluate(broken), json!(0));
    // The page scrolls only vertically.
    let wide = "document.documentElement.scrollWidth <= document.documentElement.clientWidth";
    assert_eq!(chrome.evaluate(wide), json!(true));
    fs::write(file.with_extension("png"), chrome.screenshot()).unwrap();
    fs::write(file.with_extension("pdf"), chrome.pdf()).unwrap();
}

/// The answer is on one page, and a link to what is folded unfolds it.
#[test]
fn the_answer_is_one_page_and_details_unfold() {
    let file = save(&rotor(), "folded");
    let Some(mut chrome) = Chrome::start("folded") else {
        return;
    };
    chrome.open(&file);
    let height = chrome.number("document.documentElement.scrollHeight");
    assert!(height < 3000.0, "{height}");
    assert_eq!(chrome.evaluate("document.querySelector('#modes').open"), json!(false));
    chrome.evaluate("document.querySelector('nav a[href=\"#modes\"]').click()");
    chrome.evaluate("new Promise((done) => setTimeout(done, 100))");
    assert_eq!(chrome.evaluate("document.querySelector('#modes').open"), json!(true));
    assert!(chrome.number("document.documentElement.scrollHeight") > height);
}

/// Faults of the chart texts: cut off by the edge, covered by others, or under the legend.
const WORDS: &str = "(() => { const wrong = []; \
    const apart = (a, b) => a.left >= b.right - 1 || b.left >= a.right - 1 || a.top >= b.bottom - 3 || b.top >= a.bottom - 3; \
    for (const svg of document.querySelectorAll('figure .plot svg')) { \
        const title = svg.closest('figure').querySelector('h3').textContent; \
        const edge = svg.getBoundingClientRect(); \
        const legend = svg.closest('.panel').querySelector('.legend')?.getBoundingClientRect(); \
        if (legend && legend.bottom > edge.top + 1) wrong.push(`${title}: the legend covers the chart`); \
        const texts = [...svg.querySelectorAll('text')].map((own) => [own, own.getBoundingClientRect()]); \
        texts.forEach(([own, box], k) => { \
            const inside = box.left >= edge.left - 1 && box.right <= edge.right + 1 && box.top >= edge.top - 1 && box.bottom <= edge.bottom + 1; \
            if (!inside) wrong.push(`${title}: '${own.textContent}' is cut`); \
            if (own.getAttribute('transform')) return; \
            for (const [other, there] of texts.slice(0, k)) \
                if (!other.getAttribute('transform') && !apart(box, there)) wrong.push(`${title}: '${own.textContent}' covers '${other.textContent}'`); \
        }); } \
    return wrong; })()";

#[test]
fn no_words_of_a_chart_are_cut_or_covered() {
    let Some(mut chrome) = opened("words") else {
        return;
    };
    for width in [1200, 800, 420] {
        let size = json!({ "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": false });
        chrome.ask("Emulation.setDeviceMetricsOverride", size);
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("words.html");
        chrome.open(&file);
        let charts = chrome.number("document.querySelectorAll('figure .plot svg').length");
        assert!(charts > 10.0, "{charts}");
        assert_eq!(chrome.evaluate(WORDS), json!([]), "{width} pixels");
    }
    // The check detects a fault.
    let moved = "{ const text = document.querySelector('figure .axes text'); text.setAttribute('x', '-60'); }";
    chrome.evaluate(moved);
    let found = chrome.evaluate(WORDS);
    assert!(found.as_array().is_some_and(|own| !own.is_empty()));
}

/// A chart shows everything in its figure: as many curves, markers and bars, and a legend entry for each label.
#[test]
fn charts_have_everything_of_their_figures() {
    let Some(mut chrome) = opened("structure") else {
        return;
    };
    let wrong = "(() => { const wrong = []; \
        for (const figure of document.querySelectorAll('figure')) { \
            const { panels } = JSON.parse(figure.querySelector('script').textContent); \
            const drawn = [...figure.querySelectorAll('.panel')]; \
            const title = figure.querySelector('h3').textContent; \
            if (drawn.length !== panels.length) wrong.push(`${title}: panels`); \
            panels.forEach((panel, k) => { \
                const count = (selector) => drawn[k].querySelectorAll(selector).length; \
                const same = (what, a, b) => { if (a !== b) wrong.push(`${title}: ${what}: ${a} of ${b}`); }; \
                const sum = (all, of) => all.reduce((total, own) => total + of(own), 0); \
                same('pieces of curves', count('g.curve path'), sum(panel.curves, (own) => own.pieces.length)); \
                same('bands', count('g.band path'), panel.bands.length); \
                same('bars', count('g.bars rect'), sum(panel.bars, (own) => own.bars.length)); \
                same('marks', count('g.mark line'), panel.marks.length); \
                same('groups of markers', count('g.markers'), panel.markers.length); \
                same('labels', count('text.label'), panel.labels.filter(({ at }) => at[0] >= panel.x.range[0] && at[0] <= panel.x.range[1] && at[1] >= panel.y.range[0] && at[1] <= panel.y.range[1]).length); \
                const labels = ['curves', 'bands', 'bars', 'marks', 'error_bars', 'markers'].flatMap((kind) => panel[kind].map((own) => own.label)); \
                same('entries of the legend', count('.legend button'), new Set(labels.filter((label) => label)).size); \
                const dashes = [...drawn[k].querySelectorAll('g.curve')].map((own) => own.querySelector('path')?.getAttribute('stroke-dasharray') ? 1 : 0); \
                same('dashed curves', sum(dashes, (own) => own), panel.curves.filter((own) => own.stroke !== 'solid').length); \
            }); } \
        return wrong; })()";
    assert_eq!(chrome.evaluate(wrong), json!([]));
}

/// Points, bands and bars are at the places given by the axis numbers.
#[test]
fn everything_stands_where_the_axes_say() {
    let Some(mut chrome) = opened("places") else {
        return;
    };
    let wrong = "(() => { const wrong = []; let seen = 0; \
        for (const figure of document.querySelectorAll('figure')) { \
            const { panels } = JSON.parse(figure.querySelector('script').textContent); \
            const title = figure.querySelector('h3').textContent; \
            [...figure.querySelectorAll('.plot svg')].forEach((svg, k) => { \
                const panel = panels[k]; \
                if (panel.x.categories.length + panel.y.categories.length > 0) return; \
                const lines = (upright) => [...svg.querySelectorAll('.axes line.grid')].filter((own) => (own.getAttribute('x1') === own.getAttribute('x2')) === upright); \
                const texts = [...svg.querySelectorAll('.axes text')]; \
                const scale = (upright) => { \
                    const [from, to] = upright ? [0, lines(true).length - 1] : [lines(true).length, texts.length - (panel.y.name ? 3 : 2)]; \
                    const place = (n) => Number(lines(upright)[n].getAttribute(upright ? 'x1' : 'y1')); \
                    const [a, b] = [Number(texts[from].textContent), Number(texts[to].textContent)]; \
                    const [p, q] = [place(0), place(lines(upright).length - 1)]; \
                    return (value) => p + (q - p) * (value - a) / (b - a); }; \
                const [x, y] = [scale(true), scale(false)]; \
                const near = (what, [p, q], at) => { seen += 1; if (!(Math.hypot(x(at[0]) - p, y(at[1]) - q) < 0.6)) wrong.push(`${title}: ${what} ${at} at ${p} ${q}`); }; \
                const corners = (path) => path.getAttribute('d').replace('Z', '').slice(1).split('L').map((own) => own.split(' ').map(Number)); \
                const paths = [...svg.querySelectorAll('g.curve path')]; \
                panel.curves.flatMap((own) => own.pieces).forEach((piece, n) => corners(paths[n]).forEach((at, m) => near('curve', at, piece[m]))); \
                const bands = [...svg.querySelectorAll('g.band path')]; \
                panel.bands.forEach((band, n) => { const all = corners(bands[n]); band.edges.forEach(([at, low, high], m) => { near('band', all[m], [at, high]); near('band', all[all.length - 1 - m], [at, low]); }); }); \
                const rects = [...svg.querySelectorAll('g.bars rect')]; \
                panel.bars.flatMap((own) => own.bars).forEach(([left, right, low, high], n) => { \
                    const [a, b, w, h] = ['x', 'y', 'width', 'height'].map((name) => Number(rects[n].getAttribute(name))); \
                    near('bar', [a, b], [left, high]); near('bar', [a + w, b + h], [right, low]); }); \
                const groups = [...svg.querySelectorAll('g.errors')]; \
                panel.error_bars.forEach((own, n) => own.bars.forEach((bar, m) => { \
                    const line = groups[n].querySelectorAll('line')[3 * m + (own.shape === 'cross' ? 2 * m : 0)]; \
                    const end = (e) => [Number(line.getAttribute(`x${e}`)), Number(line.getAttribute(`y${e}`))]; \
                    near('interval', end(1), bar.low); near('interval', end(2), bar.high); })); \
            }); } \
        return [seen, ...wrong.slice(0, 9)]; })()";
    let found = chrome.evaluate(wrong);
    let found = found.as_array().expect("a list");
    assert!(found[0].as_f64().unwrap() > 1000.0, "{found:?}");
    assert_eq!(found.len(), 1, "{found:?}");
}

/// In dark mode the page is light on dark.
#[test]
fn a_dark_screen_does_not_hide_the_page() {
    let Some(mut chrome) = opened("dark") else {
        return;
    };
    let features = json!({ "features": [{ "name": "prefers-color-scheme", "value": "dark" }] });
    chrome.ask("Emulation.setEmulatedMedia", features);
    let dim = "[...document.querySelectorAll('body, p, td, th, li, h2, button, .axes text')].filter((own) => { \
        const style = getComputedStyle(own); \
        const ink = own instanceof SVGElement ? style.fill : style.color; \
        return ink.match(/[0-9.]+/g).slice(0, 3).every((channel) => Number(channel) < 110); }).length";
    assert_eq!(chrome.evaluate(dim), json!(0));
    let paper = "getComputedStyle(document.body).backgroundColor";
    assert_eq!(chrome.text(paper), "rgb(21, 25, 30)");
}

#[test]
fn the_pointer_and_the_keys_show_values() {
    let Some(mut chrome) = opened("hover") else {
        return;
    };
    let figure = chart("Campbell diagram");
    middle(&mut chrome, &format!("{figure}.querySelector('svg[tabindex]')"));
    // The drawn position of a point of the first curve.
    let place = |axis: usize| {
        format!(
            "(() => {{ const svg = {figure}.querySelector('svg[tabindex]'); \
              const path = svg.querySelector('g.curve path'); \
              const [x, y] = path.getAttribute('d').slice(1).split('L')[20].split(' ').map(Number); \
              const at = new DOMPoint(x, y).matrixTransform(svg.getScreenCTM()); return [at.x, at.y][{axis}]; }})()"
        )
    };
    let at = [0, 1].map(|axis| chrome.number(&place(axis)));
    chrome.mouse("mouseMoved", at);
    let tip = format!("{figure}.querySelector('.tip')");
    assert_eq!(chrome.evaluate(&format!("{tip}.hidden")), json!(false));
    let text = chrome.text(&format!("{tip}.textContent"));
    // The data values there.
    let expected = chrome.text(&format!(
        "(() => {{ const {{ panels }} = JSON.parse({figure}.querySelector('script').textContent); \
          return panels[0].curves[0].pieces[0][20][0].toPrecision(6); }})()"
    ));
    let speed: f64 = expected.parse().unwrap();
    assert!(text.contains(&format!("speed: {speed} rpm")), "{text} lacks {speed}");
    assert!(text.contains("frequency: ") && text.contains("Hz"), "{text}");
    chrome.evaluate(&format!("{figure}.querySelector('svg[tabindex]').focus()"));
    chrome.key("ArrowRight");
    let first = chrome.text(&format!("{tip}.textContent"));
    chrome.key("ArrowRight");
    let second = chrome.text(&format!("{tip}.textContent"));
    assert!(first.contains("speed: ") && first != second, "{first} {second}");
}

#[test]
fn the_legend_hides_what_it_names() {
    let Some(mut chrome) = opened("legend") else {
        return;
    };
    let figure = chart("Campbell diagram");
    let curves = format!("{figure}.querySelectorAll('g.curve').length");
    let before = chrome.number(&curves);
    let button =
        format!("[...{figure}.querySelectorAll('.legend button')].find((own) => own.textContent.startsWith('mode'))");
    let at = middle(&mut chrome, &button);
    chrome.drag(at, at);
    assert_eq!(chrome.evaluate(&format!("{button}.getAttribute('aria-pressed')")), json!("false"));
    assert_eq!(chrome.number(&curves), before - 1.0);
    chrome.evaluate(&format!("{button}.focus()"));
    chrome.key("Enter");
    assert_eq!(chrome.number(&curves), before);
}

#[test]
fn a_rectangle_zooms_and_a_double_click_shows_all() {
    let Some(mut chrome) = opened("zoom") else {
        return;
    };
    let figure = chart("Campbell diagram");
    let svg = format!("{figure}.querySelector('svg[tabindex]')");
    let ticks = format!("[...{svg}.querySelectorAll('.axes text')].map((own) => own.textContent).join(' ')");
    let [x, y] = middle(&mut chrome, &svg);
    let all = chrome.text(&ticks);
    chrome.drag([x - 60.0, y - 50.0], [x + 60.0, y + 50.0]);
    let part = chrome.text(&ticks);
    assert_ne!(all, part);
    chrome.evaluate(&format!("{svg}.dispatchEvent(new MouseEvent('dblclick', {{ bubbles: true }}))"));
    assert_eq!(chrome.text(&ticks), all);
}

/// The number of non-white pixels on the large canvas, and a checksum that distinguishes pictures.
const PIXELS: &str = "(() => { const canvas = document.querySelector('canvas.view3d'); \
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height); \
    let [inked, sum] = [0, 0]; \
    for (let k = 0; k < data.length; k += 4) if (data[k] + data[k + 1] + data[k + 2] < 750) { inked += 1; sum = (sum * 31 + k + data[k]) % 1000003; } \
    return [inked, sum]; })()";

#[test]
fn the_mechanism_is_seen_turned_and_moved() {
    let Some(mut chrome) = opened("space") else {
        return;
    };
    let at = middle(&mut chrome, "document.querySelector('canvas.view3d')");
    let rest = chrome.evaluate(PIXELS);
    assert!(rest[0].as_f64().unwrap() > 5_000.0, "{rest}");
    chrome.drag(at, [at[0] + 90.0, at[1] + 40.0]);
    let turned = chrome.evaluate(PIXELS);
    assert_ne!(rest, turned);
    // A mode, held at two phases.
    let choose = "document.querySelectorAll('.gallery button')[1].click()";
    let hold = |phase: u32| {
        format!(
            "(() => {{ const own = document.querySelector('input[type=range]'); own.value = {phase}; own.dispatchEvent(new Event('input')); }})()"
        )
    };
    chrome.evaluate(choose);
    chrome.evaluate(&hold(0));
    let start = chrome.evaluate(PIXELS);
    chrome.evaluate(&hold(180));
    let half = chrome.evaluate(PIXELS);
    assert!(start != turned && half != start, "{start} {half}");
    chrome.evaluate(&hold(360));
    assert_eq!(chrome.evaluate(PIXELS), start, "a period ends where it begins");
    // Once played, it moves by itself.
    chrome.evaluate(
        "[...document.querySelectorAll('.controls button')].find((own) => own.textContent === 'Play').click()",
    );
    let moved = (0..100).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(30));
        chrome.evaluate(PIXELS) != start
    });
    assert!(moved);
    // Frequent pixel reads are caused by this test.
    let own = |complaint: &String| !complaint.contains("willReadFrequently");
    assert!(!chrome.complaints.iter().any(own), "{:?}", chrome.complaints);
}

/// Seen from the front: how far the letter of y is above that of x, how far it is from that of z, and the height and
/// width of the filled area. The rotor's gravity is along -y, and its disk turns about z.
const FRONT: &str = "(() => { const own = CanvasRenderingContext2D.prototype; const { fillText, beginPath, lineTo, fill } = own; \
    const letters = {}; const all = []; let corners = []; \
    own.fillText = function (text, x, y) { letters[text] = y; }; \
    own.beginPath = function () { corners = []; return beginPath.call(this); }; \
    own.lineTo = function (x, y) { corners.push([x, y]); return lineTo.call(this, x, y); }; \
    own.fill = function () { if (this.canvas.matches('.view3d')) all.push(...corners); return fill.call(this); }; \
        [...document.querySelectorAll('.controls button')].find((one) => one.textContent === 'From the front').click(); \
    Object.assign(own, { fillText, beginPath, lineTo, fill }); \
    const size = (k) => { const values = all.map((corner) => corner[k]); return Math.max(...values) - Math.min(...values); }; \
    return [letters.x - letters.y, Math.abs(letters.x - letters.z), size(1), size(0)]; })()";

#[test]
fn gravity_is_downwards() {
    let Some(mut chrome) = opened("gravity") else {
        return;
    };
    let found = chrome.evaluate(FRONT);
    let [above, level, high, wide] = [0_usize, 1, 2, 3].map(|k| found[k].as_f64().unwrap());
    assert!(above > 20.0 && level < 1.0, "{found}");
    assert!(high > 2.0 * wide, "{found}");
}

#[test]
fn a_table_is_copied_with_all_its_digits() {
    let Some(mut chrome) = opened("copy") else {
        return;
    };
    // Intercepts text bound for the clipboard, which a headless browser may lack.
    chrome.evaluate("document.execCommand = () => { window.caught = document.activeElement.value; return true; }");
    chrome.evaluate(
        "Object.defineProperty(navigator, 'clipboard', { value: { writeText: async () => { throw new Error(); } } })",
    );
    let button = "document.querySelector('#modes [data-copy]')";
    let at = middle(&mut chrome, button);
    chrome.drag(at, at);
    chrome.evaluate("new Promise((done) => setTimeout(done, 50))");
    let text = chrome.text("window.caught");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 5, "{text}");
    assert!(lines[0].starts_with("mode\tfrequency [rad/s]\t"), "{text}");
    let study = rotor_modes();
    for (line, expected) in lines[1..].iter().zip(study) {
        let frequency: f64 = line.split('\t').nth(1).unwrap().parse().unwrap();
        assert_eq!(Some(frequency), expected);
    }
}

/// The frequencies in the report of the rotor.
fn rotor_modes() -> Vec<Option<f64>> {
    let mechanism = Interpreted::from_text(&declaration("jeffcott_rotor")).unwrap();
    let study = Study::new(mechanism);
    let speed = study.find_input("speed").unwrap();
    let study = study.input(speed, InDeclaredUnit(3000.0));
    study.modes().unwrap().frequencies().to_vec()
}

/// A declaration in which every text tries to break out of its markup.
#[test]
fn words_from_outside_run_nothing() {
    let attack = "</script><script>window.broken = 1</script><img src=x onerror='window.broken = 1'>";
    let report = rotor().title(attack).declaration(attack);
    let file = save(&report, "attack");
    let Some(mut chrome) = Chrome::start("attack") else {
        return;
    };
    chrome.open(&file);
    assert_eq!(chrome.complaints, Vec::<String>::new());
    assert_eq!(chrome.evaluate("window.broken === undefined"), json!(true));
    assert_eq!(chrome.text("document.title"), attack);
    assert_eq!(chrome.text("document.querySelector('pre').textContent"), attack);
}
