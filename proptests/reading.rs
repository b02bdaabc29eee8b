//! Parses formulas from text: the printed formula must have the intended value.

use planar_impact::Real;
use std::collections::HashMap;

/// The definitions of a printed formula: each name with the lines of its value, and the indentation of each line.
pub struct Reader {
    definitions: HashMap<String, Vec<(usize, String)>>,
    formula: String,
}

impl Reader {
    pub fn of(text: &str) -> Reader {
        let (mut definitions, mut formula) = (HashMap::new(), None);
        let mut name = String::new();
        let mut margin = 0;
        for line in text.lines().filter(|line| !line.is_empty() && *line != "where") {
            match line.split_once(" = ") {
                Some((label, value)) => {
                    name = label.trim().to_owned();
                    margin = label.chars().count() + 3;
                    formula.get_or_insert_with(|| name.clone());
                    assert!(definitions.insert(name.clone(), vec![(0, value.to_owned())]).is_none(), "{name} is defined twice in {text}");
                }
                None => {
                    let indent = line.chars().take_while(|letter| *letter == ' ').count();
                    let lines: &mut Vec<(usize, String)> = definitions.get_mut(&name).expect("a line continues a definition");
                    lines.push((indent - margin, line.trim().to_owned()));
                }
            }
        }
        Reader { definitions, formula: formula.expect("there is a formula") }
    }

    /// Evaluates the formula, given the values of the variables.
    pub fn value<T: Real>(&self, variables: &HashMap<&str, T>) -> T {
        self.quantity(&self.formula, variables)
    }

    fn quantity<T: Real>(&self, name: &str, variables: &HashMap<&str, T>) -> T {
        let Some(lines) = self.definitions.get(name) else {
            return variables.get(name).unwrap_or_else(|| panic!("{name} is not defined")).clone();
        };
        // Values, each followed by its condition, which is indented further.
        let mut parts: Vec<String> = Vec::new();
        let mut conditional = false;
        for (indent, line) in lines {
            let starts = line.starts_with("if ") || line == "otherwise" || (*indent == 0 && conditional);
            conditional = *indent > 0;
            match parts.last_mut() {
                Some(last) if !starts => *last += &format!(" {line}"),
                _ => parts.push(line.clone()),
            }
        }
        let read = |text: &str| Line { rest: text, reader: self, variables }.all();
        let Some((value, cases)) =
            parts.split_last().filter(|(last, _)| *last == "otherwise").map(|(_, cases)| (&cases[cases.len() - 1], cases))
        else {
            let [value] = &parts[..] else { panic!("{parts:?} is neither a value nor a choice") };
            return read(value);
        };
        // The first condition that holds decides.
        cases[..cases.len() - 1].chunks(2).rev().fold(read(value), |otherwise, case| {
            let [value, condition] = case else { panic!("{case:?} is not a value and its condition") };
            let (left, right) = condition.strip_prefix("if ").and_then(|condition| condition.split_once(" < ")).expect("a condition");
            T::select(read(left).less(&read(right)), read(value), otherwise)
        })
    }
}

/// The unread rest of a line.
struct Line<'a, T> {
    rest: &'a str,
    reader: &'a Reader,
    variables: &'a HashMap<&'a str, T>,
}

impl<T: Real> Line<'_, T> {
    fn all(mut self) -> T {
        let value = self.sum();
        assert_eq!(self.rest, "", "not understood");
        value
    }

    fn take(&mut self, token: &str) -> bool {
        match self.rest.strip_prefix(token) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn expect(&mut self, token: &str) {
        assert!(self.take(token), "expected {token} before {}", self.rest);
    }

    fn sum(&mut self) -> T {
        let mut sum = if self.take("−") { -self.term() } else { self.term() };
        loop {
            if self.take(" + ") {
                sum = sum + self.term();
            } else if self.take(" − ") {
                sum = sum - self.term();
            } else {
                return sum;
            }
        }
    }

    /// Parses adjacent factors, and one divisor.
    fn term(&mut self) -> T {
        let mut product = self.factor();
        while !self.rest.starts_with(" +") && !self.rest.starts_with(" −") && self.take(" ") {
            product = product * self.factor();
        }
        if self.take("/") {
            product = product / self.factor();
        }
        product
    }

    fn factor(&mut self) -> T {
        let base = self.atom();
        let exponent = self.exponent();
        (1..exponent).fold(base.clone(), |power, _| power * base.clone())
    }

    fn exponent(&mut self) -> u32 {
        const RAISED: [&str; 10] = ["⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"];
        let mut exponent = None;
        while let Some(digit) = RAISED.iter().position(|raised| self.take(raised)) {
            exponent = Some(exponent.unwrap_or(0) * 10 + digit as u32);
        }
        exponent.unwrap_or(1)
    }

    fn atom(&mut self) -> T {
        for (sign, numerator, denominator) in [("½", 1, 2), ("⅓", 1, 3), ("⅔", 2, 3), ("¼", 1, 4), ("¾", 3, 4)] {
            if self.take(sign) {
                return T::int(numerator) / T::int(denominator);
            }
        }
        if self.take("(") {
            let value = self.sum();
            self.expect(")");
            return value;
        }
        if self.take("|") {
            let value = self.sum();
            self.expect("|");
            return value.magnitude();
        }
        if self.take("√") {
            return self.atom().square_root();
        }
        if self.take("atan2(") {
            let y = self.sum();
            self.expect(", ");
            let x = self.sum();
            self.expect(")");
            return (y + T::int(0)).arctangent(x + T::int(0));
        }
        for circular in ["sin", "cos"] {
            if self.rest.starts_with(circular) {
                self.expect(circular);
                let exponent = self.exponent();
                self.take(" ");
                let (sin, cos) = self.atom().sin_and_cos();
                let value = if circular == "sin" { sin } else { cos };
                return (1..exponent).fold(value.clone(), |power, _| power * value.clone());
            }
        }
        let digits = self.word(|letter| letter.is_ascii_digit());
        if !digits.is_empty() {
            return digits
                .chars()
                .fold(T::int(0), |number, digit| number * T::int(10) + T::int(digit.to_digit(10).expect("a digit") as i32));
        }
        let mut name = self.word(|letter| letter.is_ascii_alphanumeric() || "∂Δ_′".contains(letter));
        if name.starts_with('∂') {
            self.expect("/");
            name = format!("{name}/{}", self.word(|letter| letter.is_ascii_alphanumeric() || letter == '∂'));
        }
        assert!(!name.is_empty(), "expected a quantity before {}", self.rest);
        self.reader.quantity(&name, self.variables)
    }

    fn word(&mut self, is_part: impl Fn(char) -> bool) -> String {
        let end = self.rest.find(|letter| !is_part(letter)).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        word.to_owned()
    }
}
