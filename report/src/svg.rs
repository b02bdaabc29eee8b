//! Elements of SVG: every text is escaped, every number has at most two decimals.

use std::fmt::Write;

use planar_impact_app::plain_text::{shorten, shown};
use quick_xml::escape::escape;
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

/// A place on the page, in pixels: to the right, down.
pub type Place = (f64, f64);

/// Fonts of every drawing; the first that a reader has is used.
const FONTS: &str = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";
/// Width of a column of text over its size: that of the widest of these fonts.
const COLUMN: f64 = 0.64;

/// Returns the most pixels that a text takes.
pub fn text_width(text: &str, size: f64) -> f64 {
    COLUMN * size * shown(text).width() as f64
}

/// Shortens a text until it fits a width, whatever its letters are.
pub fn fitting(text: &str, size: f64, width: f64) -> String {
    let most = (width / (COLUMN * size)) as usize;
    let fits = |text: &String| text.chars().map(|letter| widest(letter) * size).sum::<f64>() <= width;
    (1..=most).rev().map(|most| shorten(text, most)).find(fits).unwrap_or_default()
}

/// Returns the width of a letter in the widest of the fonts, over its size.
fn widest(letter: char) -> f64 {
    match letter {
        'W' | 'M' | 'm' | '@' | '%' => 1.0,
        'A'..='Z' | 'w' | '&' => 0.86,
        _ => COLUMN * letter.width().unwrap_or(0) as f64,
    }
}

/// An SVG document being written.
pub struct Svg(String);

impl Svg {
    /// Starts a document. A screen reader reads its title and description.
    pub fn new(width: f64, height: f64, title: &str, description: &str) -> Svg {
        let mut svg = Svg(String::new());
        let (width, height) = (number(width), number(height));
        svg.open(
            "svg",
            &[
                ("xmlns", "http://www.w3.org/2000/svg"),
                ("width", &width),
                ("height", &height),
                ("viewBox", &format!("0 0 {width} {height}")),
                ("role", "img"),
                ("font-family", FONTS),
            ],
        );
        svg.title(title);
        svg.element_with("desc", &[], description);
        svg
    }

    /// Adds a title, which a reader sees when pointing at what it is in.
    pub fn title(&mut self, text: &str) {
        self.element_with("title", &[], text);
    }

    /// Adds an element without content.
    pub fn element(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.tag(name, attributes);
        self.0.push_str("/>\n");
    }

    /// Adds an element with a text.
    pub fn element_with(&mut self, name: &str, attributes: &[(&str, &str)], text: &str) {
        self.tag(name, attributes);
        let _ = writeln!(self.0, ">{}</{name}>", escape(shown(text)));
    }

    /// Adds a group.
    pub fn group(&mut self, attributes: &[(&str, &str)], content: impl FnOnce(&mut Svg)) {
        self.open("g", attributes);
        content(self);
        self.0.push_str("</g>\n");
    }

    /// Adds a line of text from a place on its base line.
    pub fn text(&mut self, at: Place, size: f64, class: &str, text: &str) {
        let (x, y) = (number(at.0), number(at.1));
        self.element_with("text", &[("class", class), ("x", &x), ("y", &y), ("font-size", &number(size)), ("fill", INK)], text);
    }

    /// Adds a line.
    pub fn line(&mut self, from: Place, to: Place, attributes: &[(&str, &str)]) {
        let ends = [from.0, from.1, to.0, to.1].map(number);
        let mut all = vec![("x1", &*ends[0]), ("y1", &*ends[1]), ("x2", &*ends[2]), ("y2", &*ends[3])];
        all.extend_from_slice(attributes);
        self.element("line", &all);
    }

    /// Adds a polygon, or with `polyline` an open line.
    pub fn points(&mut self, name: &str, points: &[Place], attributes: &[(&str, &str)]) {
        let list: Vec<String> = points.iter().map(|(x, y)| format!("{},{}", number(*x), number(*y))).collect();
        let list = list.join(" ");
        let mut all = vec![("points", &*list)];
        all.extend_from_slice(attributes);
        self.element(name, &all);
    }

    /// Adds a circle.
    pub fn circle(&mut self, at: Place, radius: f64, attributes: &[(&str, &str)]) {
        let numbers = [at.0, at.1, radius].map(number);
        let mut all = vec![("cx", &*numbers[0]), ("cy", &*numbers[1]), ("r", &*numbers[2])];
        all.extend_from_slice(attributes);
        self.element("circle", &all);
    }

    /// Ends the document.
    pub fn finish(mut self) -> String {
        self.0.push_str("</svg>\n");
        self.0
    }

    fn open(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.tag(name, attributes);
        self.0.push_str(">\n");
    }

    fn tag(&mut self, name: &str, attributes: &[(&str, &str)]) {
        let _ = write!(self.0, "<{name}");
        for (key, value) in attributes {
            let _ = write!(self.0, " {key}=\"{}\"", escape(shown(value)));
        }
    }
}

/// Color of text and of what belongs to no vehicle: a contrast of 17 on white.
pub const INK: &str = "#1a1a1a";

/// Writes a number of pixels.
pub fn number(value: f64) -> String {
    if value.is_nan() || value.abs() >= 1e12 {
        return format!("{value:.2}");
    }
    // A drawing has thousands of them, and whole numbers are written faster than floats.
    let hundredths = libm::round(100.0 * value) as i64;
    let (sign, size) = (if hundredths < 0 { "-" } else { "" }, hundredths.unsigned_abs());
    match (size / 100, size % 100) {
        (whole, 0) => format!("{sign}{whole}"),
        (whole, part) if part % 10 == 0 => format!("{sign}{whole}.{}", part / 10),
        (whole, part) => format!("{sign}{whole}.{part:02}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wide_is_cut_sooner() {
        // A letter of COLUMN takes 6.4 px, a W 10 px.
        assert_eq!(fitting("sedan", 10.0, 32.0), "sedan");
        assert_eq!(fitting("sedans", 10.0, 32.0), "seda…");
        assert_eq!(fitting("WWWWW", 10.0, 50.0), "WWWWW");
        assert_eq!(fitting("WWWWWW", 10.0, 50.0), "WWWW…");
        assert_eq!(fitting("W", 10.0, 5.0), "");
    }

    #[test]
    fn texts_cannot_add_elements() {
        let mut svg = Svg::new(10.0, 10.0, "</title><script>", "a & b");
        svg.text((0.0, 0.0), 10.0, "\"><x", "<b>\u{0}\u{202e}\u{fffe}");
        let text = svg.finish();
        assert!(!text.contains("<script") && !text.contains("<b>") && !text.contains("<x"), "{text}");
        assert!(text.contains("a &amp; b") && text.contains("U+0000") && text.contains("U+202E") && text.contains("U+FFFE"), "{text}");
    }

    #[test]
    fn numbers_are_short() {
        let written = [0.0, -0.001, 12.5, 100.0, 7.2561, -0.07, -12.30, 0.996, 1e7, f64::NAN].map(number);
        assert_eq!(written, ["0", "0", "12.5", "100", "7.26", "-0.07", "-12.3", "1", "10000000", "NaN"]);
    }
}
