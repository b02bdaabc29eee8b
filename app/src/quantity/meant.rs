//! What was meant by a unit with an unknown name: a unit is proposed only if, in its place, it measures what is wanted.

use super::unit::{Dimension, Fault, Unit, find, names};
use super::{QuantityError, excerpt, nearest};

/// A name that is unknown, in the text of its unit.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub(super) text: &'a str,
    pub(super) begin: usize,
    pub(super) end: usize,
}

impl<'a> Place<'a> {
    fn name(self) -> &'a str {
        &self.text[self.begin..self.end]
    }

    /// Returns the whole with another name in this place.
    fn with(self, meant: &str) -> String {
        [&self.text[..self.begin], meant, &self.text[self.end..]].concat()
    }

    /// Returns `true` if the whole then measures what is wanted, or if that cannot be told.
    fn fits(self, meant: &str, wanted: Option<Dimension>) -> bool {
        wanted.is_none_or(|wanted| Unit::read(&self.with(meant)).is_ok_and(|unit| unit.measures(wanted)))
    }
}

const BRACKETS: [char; 7] = ['[', ']', '(', ')', '{', '}', ' '];

/// Other signs of division and multiplication.
const SIGNS: [(&[char], char); 2] = [(&['\u{2215}', '\u{2044}', '\u{f7}'], '/'), (&['\u{d7}', '\u{2219}', '\u{2022}', '.'], '*')];

/// How to write a product behind a sign of division.
pub(super) const PRODUCTS_FIRST: &str = "put the products first and a `/` before each divisor, as in `lbf s/ft/in`";

/// Longest text of which it is asked what was meant, in bytes.
const LONGEST: usize = 100;

/// Returns the error of a unit with an unknown name, and what was meant.
pub(super) fn unknown(place: Place<'_>, wanted: Option<Dimension>) -> QuantityError {
    let (name, unit) = (place.name(), place.text);
    let message = match name {
        "" => format!("the name of a unit is missing in {}", excerpt(unit)),
        _ => format!("unknown unit {}", excerpt(name)),
    };
    match Some(unit).filter(|unit| unit.len() <= LONGEST).and_then(|_| remedy(place, wanted)) {
        Some(remedy) => QuantityError::with_help(message, remedy),
        None => QuantityError::new(message),
    }
}

fn remedy(place: Place<'_>, wanted: Option<Dimension>) -> Option<String> {
    let (name, unit) = (place.name(), place.text);
    let did_you_mean = |meant: String| format!("did you mean `{meant}`?");
    if unit.starts_with(['[', '(', '{']) {
        return Some(match in_parentheses(unit) {
            Some((digits, unit)) => format!("write a standard deviation as in `12 ± {digits} {unit}`"),
            None => format!("write it without brackets: `{}`", unit.trim_matches(BRACKETS)),
        });
    }
    if unit.contains('(') {
        return Some(format!("write it without brackets: {PRODUCTS_FIRST}"));
    }
    if let Some(meant) = in_ordinary_signs(unit, wanted) {
        return Some(did_you_mean(meant));
    }
    // What has no letter is no name of a unit.
    if !name.contains(char::is_alphabetic) {
        return None;
    }
    if let Some(several) = several(name) {
        return Some(several.to_owned());
    }
    if let Some(base) = name.strip_prefix('\u{221a}') {
        return Some(format!("write `{base}^0.5`"));
    }
    if let Some(meant) = run_together(place, wanted) {
        return Some(did_you_mean(meant));
    }
    // Without them the nearest name would be that of something else.
    for (signs, ordinary) in SIGNS {
        if let Some(sign) = name.chars().find(|c| signs.contains(c)) {
            return Some(format!("write `{ordinary}` for `{sign}`"));
        }
    }
    misspelled(place, wanted).map(did_you_mean)
}

/// Returns the digits in parentheses at the start of a unit, and what follows them, as of `12 (1) m/s`.
fn in_parentheses(unit: &str) -> Option<(&str, &str)> {
    let (digits, unit) = unit.strip_prefix('(')?.split_once(')')?;
    digits.trim().parse::<f64>().is_ok().then_some((digits.trim(), unit.trim()))
}

/// Returns what is said of names that may be those of several units, or of one that has another name here.
fn several(name: &str) -> Option<&'static str> {
    Some(match name.to_lowercase().as_str() {
        "ton" | "tons" => "a ton is 2000 lb in America, 2240 lb in Britain and 1000 kg elsewhere: write `lb`, `kg` or `tonne`",
        "kgf" | "kp" => "a kilogram-force is 9.80665 N: write `N`",
        "mps" => "write `m/s`",
        "fpm" => "write `ft/min`",
        "kts" => "write `kn`",
        "ips" => "write `in/s`",
        "nmi" => "a nautical mile is 1852 m, and one in an hour a knot: write `m` or `kn`",
        "nm" | "pt" | "pts" if name != "Nm" => "write the length in `m`, `mm`, `ft` or `in`",
        "nms" => "write `N m s`",
        "mrad" | "mrads" => "write `rad` or `deg`",
        "stone" | "stones" => "a stone is 14 lb: write `lb` or `kg`",
        "grad" | "grads" | "gradian" | "gradians" => "it is a 400th of a turn to surveyors and a 360th in German: write `gon` or `deg`",
        _ => return None,
    })
}

/// Returns a unit with the ordinary signs of division and multiplication, and a sign before each exponent, if that makes one: `m*s^-1` of `m.s-1`, `mph` of `m.p.h.`,
/// `feet/second` of `feet per second`, `kg m^2` of `kg sq m`, `kg m**2` and, where that is wanted, `kgm2`.
fn in_ordinary_signs(unit: &str, wanted: Option<Dimension>) -> Option<String> {
    let plain = squares(&unit.trim_end_matches('.').replace(" per ", "/").replace("**", "^"));
    let mut meant = String::new();
    let mut last = None::<char>;
    for (at, c) in plain.char_indices() {
        let ordinary = SIGNS.iter().find(|(signs, _)| signs.contains(&c)).map_or(c, |(_, ordinary)| *ordinary);
        let is_exponent = c.is_ascii_digit() || (c == '-' && plain[at + 1..].starts_with(|next: char| next.is_ascii_digit()));
        if is_exponent && last.is_some_and(char::is_alphabetic) {
            meant.push('^');
        }
        meant.push(ordinary);
        last = Some(c);
    }
    let without_points = unit.replace('.', "");
    let known = [without_points, meant.clone()].into_iter().find(|meant| meant != unit && Unit::read(meant).is_ok());
    // The names between other signs may be run together besides.
    known.or_else(|| match Unit::read(&meant) {
        Err(Fault::Unknown { begin, end }) if meant != unit => {
            let place = Place { text: &meant, begin, end };
            run_together(place, wanted).map(|part| place.with(&part)).filter(|meant| Unit::read(meant).is_ok())
        }
        _ => None,
    })
}

/// Returns a unit with `m^2` for `sq m`, `square m` and `m squared`.
fn squares(unit: &str) -> String {
    let mut words: Vec<String> = Vec::new();
    let mut is_square = false;
    for word in unit.replace('/', " / ").split_whitespace() {
        match word.trim_end_matches('.') {
            "sq" | "square" => is_square = true,
            "squared" if !words.is_empty() => words.last_mut().into_iter().for_each(|last| last.push_str("^2")),
            _ => words.push(if std::mem::take(&mut is_square) { format!("{word}^2") } else { word.to_owned() }),
        }
    }
    words.join(" ").replace(" / ", "/")
}

/// Returns the two units that a name is without a space or a stroke between them, such as `kg m` of `kgm`, so that the whole measures what is wanted.
fn run_together(place: Place<'_>, wanted: Option<Dimension>) -> Option<String> {
    let name = place.name();
    let square = name.strip_prefix("sq").filter(|unit| find(unit).is_some()).map(|unit| format!("{unit}^2"));
    let pairs = name.char_indices().skip(1).map(|(place, _)| name.split_at(place));
    let known = pairs.filter(|(one, other)| find(one).is_some() && find(other).is_some());
    let of_pair = |(one, other): (&str, &str)| {
        let product = if one == other { format!("{one}^2") } else { format!("{one} {other}") };
        [product, format!("{one}/{other}")]
    };
    square.into_iter().chain(known.flat_map(of_pair)).find(|meant| place.fits(meant, wanted))
}

/// Returns the unit of which a name is a misspelling.
fn misspelled(place: Place<'_>, wanted: Option<Dimension>) -> Option<String> {
    // Beside another name that is unknown, a part may have any dimension.
    let wanted = wanted.filter(|_| Unit::read(&place.with("m")).is_ok());
    // A megagram: the nearest name is that of a milligram.
    if place.name() == "Mg" && place.fits("tonne", wanted) {
        return Some("tonne".to_owned());
    }
    nearest(place.name(), names().filter(|meant| place.fits(meant, wanted))).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        Unit::parse(text).unwrap_err().to_string()
    }

    fn meant(text: &str, wanted: &str) -> String {
        Unit::parse_as(text, Some(Unit::parse(wanted).unwrap().dimension())).unwrap_err().to_string()
    }

    #[test]
    fn what_was_meant() {
        assert_eq!(message("mhp"), "unknown unit `mhp` (did you mean `mph`?)");
        assert_eq!(message("kNs"), "unknown unit `kNs` (did you mean `kN s`?)");
        assert_eq!(message("KN"), "unknown unit `KN` (did you mean `kN`?)"); // a knot or a kilonewton
        assert!(message("tons").starts_with("unknown unit `tons` (a ton is 2000 lb in America"));
        assert!(message("Grad").starts_with("unknown unit `Grad` (it is a 400th of a turn"));
        assert_eq!(message("kgm^2"), "unknown unit `kgm` (did you mean `kg m`?)");
        assert_eq!(message("\u{221a}lbf/ft"), "unknown unit `\u{221a}lbf` (write `lbf^0.5`)");
        assert_eq!(message("lbf.s^2*ft"), "unknown unit `lbf.s` (did you mean `lbf*s^2*ft`?)");
        assert_eq!(message("m.s-1"), "unknown unit `m.s` (did you mean `m*s^-1`?)");
        assert_eq!(message("kg m2"), "unknown unit `m2` (did you mean `kg m^2`?)");
        assert_eq!(message("lbf.x"), "unknown unit `lbf.x` (write `*` for `.`)");
        assert_eq!(message("3.6 m/s"), "unknown unit `3.6`");
        assert_eq!(message("[m/s]"), "unknown unit `[m` (write it without brackets: `m/s`)");
        assert_eq!(message("ips"), "unknown unit `ips` (write `in/s`)");
        assert_eq!(message("Nms"), "unknown unit `Nms` (write `N m s`)");
        assert_eq!(message("m/ss"), "unknown unit `ss` (did you mean `s^2`?)");
        assert_eq!(message("lbfs^2/ft"), "unknown unit `lbfs` (did you mean `lbf s`?)");
        assert_eq!(message("m2"), "unknown unit `m2` (did you mean `m^2`?)");
        assert_eq!(message("m\u{2215}s"), "unknown unit `m\u{2215}s` (did you mean `m/s`?)");
        assert_eq!(message("N\u{d7}m"), "unknown unit `N\u{d7}m` (did you mean `N*m`?)");
        assert_eq!(message("furlong"), "unknown unit `furlong`");
        assert_eq!(meant("kt", "m/s"), "unknown unit `kt` (did you mean `kn`?)");
        for (typed, wanted, remedy) in [
            ("mih", "m/s", "mi/h"),
            ("fts", "m/s", "ft/s"),
            ("kmhr", "m/s", "km/hr"),
            ("m/ss", "m/s^2", "s^2"),
            ("miles per hour", "m/s", "miles/hour"),
            ("degrees per second", "rad/s", "degrees/second"),
            ("m.p.h.", "m/s", "mph"),
            ("lb.", "kg", "lb"),
            ("deg.", "rad", "deg"),
            ("kilogramms", "kg", "kilograms"),
            ("k/h", "m/s", "km"),
            ("dg/s", "rad/s", "deg"),
            ("Nm s", "N m s", "N m"),
            ("kg sq m", "kg m^2", "kg m^2"),
            ("lbf/sq. in", "N/m^2", "lbf/in^2"),
            ("kg m squared", "kg m^2", "kg m^2"),
            ("kg m**2", "kg m^2", "kg m^2"),
            ("kgm2", "kg m^2", "kg m^2"),
            ("kg sqm", "kg m^2", "m^2"),
            ("kNs", "N", "kN"),
            ("mphs", "m/s", "mph"),
        ] {
            let said = meant(typed, wanted);
            assert!(said.contains(&format!("did you mean `{remedy}`?")), "{typed}: {said}");
        }
        // What two units make is proposed only if it is what is wanted.
        for typed in ["mmph", "ftt/s"] {
            let said = meant(typed, "m/s");
            assert!(!said.contains("`m mph`") && !said.contains("`ft t`"), "{said}");
        }
        assert_eq!(meant("kt/s", "m/s^2"), "unknown unit `kt` (did you mean `kn`?)");
        // Beside another name that is unknown nothing tells the dimension.
        assert_eq!(meant("kt/sx", "m/s^2"), "unknown unit `kt` (did you mean `kg`?)");
        assert_eq!(message("Mg"), "unknown unit `Mg` (did you mean `tonne`?)");
        // Nothing is proposed that measures something else.
        for (typed, wanted) in [("m/d", "m/s"), ("xg", "m"), ("kgm", "kg m^2")] {
            let said = meant(typed, wanted);
            assert!(!said.contains("did you mean"), "{typed}: {said}");
        }
        assert_eq!(
            meant("m^2/(m s)", "m/s"),
            "unknown unit `(m` (write it without brackets: put the products first and a `/` before each divisor, as in `lbf s/ft/in`)"
        );
        assert_eq!(meant("(1) m/s", "m/s"), "unknown unit `(1)` (write a standard deviation as in `12 ± 1 m/s`)");
        assert_eq!(meant("kgf m s^2", "kg m^2"), "unknown unit `kgf` (a kilogram-force is 9.80665 N: write `N`)");
        assert_eq!(meant("nm", "m"), "unknown unit `nm` (write the length in `m`, `mm`, `ft` or `in`)");
    }

    #[test]
    fn a_long_text_is_answered_at_once() {
        for text in ["1 - ".repeat(100_000), "m.".repeat(100_000), "sq m ".repeat(100_000), "k/".repeat(49), "(1".repeat(100_000)] {
            let started = std::time::Instant::now();
            assert!(Unit::parse_as(&text, Some(Unit::parse("m").unwrap().dimension())).is_err());
            assert!(started.elapsed().as_secs() < 2, "{}", &text[..20]);
        }
    }
}
