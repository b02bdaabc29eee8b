//! Numbers as printed, and the rows that contain them.

use crate::data::DataError;

/// A number as printed: its digits matter, not only its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Printed {
    text: String,
    value: f64,
    decimals: i32,
}

impl Printed {
    /// Parses digits with at most a sign and a point; returns `None` for anything else, including exponents and infinities.
    pub fn parse(text: &str) -> Option<Self> {
        let digits = text.strip_prefix('-').unwrap_or(text);
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let plain = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
        if whole.is_empty() || !plain(whole) || !plain(fraction) {
            return None;
        }
        let decimals = i32::try_from(fraction.len()).ok()?;
        Some(Printed { text: text.to_owned(), value: text.parse().ok()?, decimals })
    }

    /// Returns the same number, treating a final zero as filler instead of a significant digit.
    pub fn without_filler(mut self) -> Self {
        if self.decimals > 0 && self.text.ends_with('0') {
            self.decimals -= 1;
        }
        self
    }

    /// Returns the printed text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns the value.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// Returns half a unit of the last digit.
    pub fn half_unit(&self) -> f64 {
        0.5 * libm::exp10(-f64::from(self.decimals))
    }

    /// Returns `true` if `computed` rounds to it. A tie may round either way regardless of its last binary digit,
    /// hence the tolerance of a millionth.
    pub fn agrees_with(&self, computed: f64) -> bool {
        (computed - self.value).abs() <= self.half_unit() * (1.0 + 1e-6)
    }
}

/// The rows of a text.
pub(crate) struct Sheet {
    file: &'static str,
    header: csv::StringRecord,
    rows: Vec<csv::StringRecord>,
}

/// A row of a text.
pub(crate) struct Row<'a> {
    sheet: &'a Sheet,
    record: &'a csv::StringRecord,
}

impl Sheet {
    pub(crate) fn read(file: &'static str, text: &str) -> Result<Self, DataError> {
        let malformed = |error: csv::Error| DataError::Malformed { file, message: error.to_string() };
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
        let header = reader.headers().map_err(malformed)?.clone();
        let rows = reader.records().collect::<Result<Vec<_>, _>>().map_err(malformed)?;
        if rows.is_empty() { Err(DataError::Empty { file }) } else { Ok(Sheet { file, header, rows }) }
    }

    /// Returns the number of nonempty fields outside the columns `but`.
    pub(crate) fn filled(&self, but: &[&str]) -> usize {
        let counts = |(name, field): &(&str, &str)| !but.contains(name) && !field.is_empty();
        self.rows.iter().map(|record| self.header.iter().zip(record).filter(counts).count()).sum()
    }

    pub(crate) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter().map(|record| Row { sheet: self, record })
    }
}

impl<'a> Row<'a> {
    pub(crate) fn text(&self, column: &'static str) -> Result<&'a str, DataError> {
        let place = self.sheet.header.iter().position(|name| name == column);
        place.and_then(|place| self.record.get(place)).ok_or(DataError::NoColumn { file: self.sheet.file, column })
    }

    pub(crate) fn number(&self, column: &'static str) -> Result<Printed, DataError> {
        let field = self.text(column)?;
        Printed::parse(field).ok_or_else(|| DataError::NotANumber { file: self.sheet.file, column, field: field.to_owned() })
    }

    /// Returns the number in a column, or `None` if nothing is printed.
    pub(crate) fn number_if_any(&self, column: &'static str) -> Result<Option<Printed>, DataError> {
        if self.text(column)?.is_empty() { Ok(None) } else { self.number(column).map(Some) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_printed_number_keeps_its_digits() {
        // Table 1, first row: μ₀ and W_n.
        let ratio = Printed::parse("0.661").expect("digits");
        assert_eq!((ratio.text(), ratio.value(), ratio.half_unit()), ("0.661", 0.661, 0.0005));
        assert!(ratio.agrees_with(0.6606) && ratio.agrees_with(0.6605) && !ratio.agrees_with(0.6604) && !ratio.agrees_with(f64::NAN));
        let work = Printed::parse("-30097.2").expect("digits");
        assert!(work.agrees_with(-30097.24) && !work.agrees_with(-30097.26));
        assert_eq!(Printed::parse("-40").map(|speed| speed.half_unit()), Some(0.5));
    }

    #[test]
    fn filler_is_no_digit() {
        // In Table B1, T_Ln of test 1 has filler, T_i of test 2 has none.
        assert_eq!(Printed::parse("14130.70").map(|p| p.without_filler().half_unit()), Some(0.05));
        assert_eq!(Printed::parse("58592.55").map(|p| p.without_filler().half_unit()), Some(0.005));
        assert_eq!(Printed::parse("10").map(|p| p.without_filler().half_unit()), Some(0.5));
    }

    #[test]
    fn what_is_not_printed_digits_is_no_number() {
        for text in ["", "-", ".5", "1e5", "inf", "NaN", "1,000", "--1", "1.2.3", "0x1", "+1"] {
            assert_eq!(Printed::parse(text), None, "{text}");
        }
    }

    #[test]
    fn a_sheet_says_what_is_wrong_with_it() {
        let sheet = Sheet::read("t.csv", "# remark\na,b\n1,x\n").expect("well formed");
        let row = sheet.rows().next().expect("one row");
        assert_eq!(row.text("b"), Ok("x"));
        assert_eq!(row.text("c"), Err(DataError::NoColumn { file: "t.csv", column: "c" }));
        assert_eq!(row.number("b"), Err(DataError::NotANumber { file: "t.csv", column: "b", field: "x".into() }));
        for empty in ["", "# remark\n", "a,b\n"] {
            assert_eq!(Sheet::read("t.csv", empty).err(), Some(DataError::Empty { file: "t.csv" }));
        }
        assert!(matches!(Sheet::read("t.csv", "a,b\n1\n").err(), Some(DataError::Malformed { .. })));
    }
}
