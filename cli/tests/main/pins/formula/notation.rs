//! Parses formulas as printed in text and in LaTeX, and evaluates them.

use std::collections::HashMap;

/// A printed definition: its name and the text after the equals sign.
type Definition = (String, String);

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Number(f64),
    Name(String),
    Function(&'static str),
    /// A character of the notation; `F` is a fraction of two groups, `R` a root of one.
    Sign(char),
    If,
    Otherwise,
}

/// The words of both notations, and their tokens. Longer words come first.
const WORDS: [(&str, Option<Token>); 35] = [
    ("\\operatorname{atan2}", Some(Token::Function("atan2"))),
    ("\\begin{cases}", Some(Token::Sign('['))),
    ("\\end{cases}", Some(Token::Sign(']'))),
    ("\\text{if }", Some(Token::If)),
    ("\\text{otherwise}", Some(Token::Otherwise)),
    ("otherwise", Some(Token::Otherwise)),
    ("\\tfrac", Some(Token::Sign('F'))),
    ("\\right", None),
    ("\\quad", None),
    ("\\frac", Some(Token::Sign('F'))),
    ("\\left", None),
    ("\\sqrt", Some(Token::Sign('R'))),
    ("atan2", Some(Token::Function("atan2"))),
    ("\\cos", Some(Token::Function("cos"))),
    ("\\sin", Some(Token::Function("sin"))),
    ("cos", Some(Token::Function("cos"))),
    ("sin", Some(Token::Function("sin"))),
    ("\\\\", Some(Token::Sign(';'))),
    (";", Some(Token::Sign(';'))),
    ("{}", None),
    ("if", Some(Token::If)),
    ("½", Some(Token::Number(0.5))),
    ("²", Some(Token::Sign('²'))),
    ("^{2}", Some(Token::Sign('²'))),
    ("√", Some(Token::Function("sqrt"))),
    ("−", Some(Token::Sign('-'))),
    ("-", Some(Token::Sign('-'))),
    ("+", Some(Token::Sign('+'))),
    ("/", Some(Token::Sign('/'))),
    ("<", Some(Token::Sign('<'))),
    ("|", Some(Token::Sign('|'))),
    (",", Some(Token::Sign(','))),
    ("&", None),
    (" ", None),
    ("\n", None),
];

fn tokens(body: &str, names: &[String]) -> Vec<Token> {
    let (mut rest, mut found) = (body, Vec::new());
    while let Some(first) = rest.chars().next() {
        let is_whole = |name: &str| {
            let next = rest[name.len()..].chars().next().unwrap_or(' ');
            !(next.is_alphanumeric() && next != '²' || next == '_' || next == '′')
        };
        let name = names.iter().filter(|name| rest.starts_with(name.as_str()) && is_whole(name)).max_by_key(|name| name.len());
        if let Some(name) = name {
            found.push(Token::Name(name.clone()));
            rest = &rest[name.len()..];
        } else if let Some((word, token)) = WORDS.iter().find(|(word, _)| rest.starts_with(word)) {
            found.extend(token.clone());
            rest = &rest[word.len()..];
        } else if first.is_ascii_digit() {
            let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
            found.push(Token::Number(rest[..end].parse().expect("a number")));
            rest = &rest[end..];
        } else {
            assert!("(){}".contains(first), "{first:?} in {body}");
            found.push(Token::Sign(first));
            rest = &rest[1..];
        }
    }
    found
}

/// Definitions that refer to each other and to inputs.
pub struct Formula {
    definitions: Vec<Definition>,
    names: Vec<String>,
    inputs: HashMap<String, f64>,
}

impl Formula {
    /// Parses text: a definition starts at the beginning of a line or is indented by two, and continues on lines with deeper indentation.
    pub fn of_text(text: &str, inputs: HashMap<String, f64>) -> Formula {
        let mut definitions: Vec<Definition> = Vec::new();
        for line in text.lines() {
            let indent = line.len() - line.trim_start().len();
            match (line.split_once(" = "), definitions.last_mut()) {
                (Some((name, body)), _) if indent == 0 || indent == 2 => definitions.push((name.trim().to_owned(), body.to_owned())),
                // A condition ends with its line.
                (None, Some((_, body))) if indent > 2 && line.trim_start().starts_with("if ") => *body += &format!("\n{line};"),
                (None, Some((_, body))) if indent > 2 => *body += &format!("\n{line}"),
                _ => (),
            }
        }
        Formula::of(definitions, inputs)
    }

    /// Parses LaTeX: a definition on each line, with an ampersand before its equals sign if there are several.
    pub fn of_latex(text: &str, inputs: HashMap<String, f64>) -> Formula {
        let mut definitions: Vec<Definition> = Vec::new();
        for line in text.lines().filter(|line| !line.starts_with('%') && !line.starts_with("\\[") && !line.starts_with("\\]")) {
            match (line.trim_end_matches("\\\\").replace("&=", "=").split_once(" = "), definitions.last_mut()) {
                (Some((name, body)), _) => definitions.push((name.trim().to_owned(), body.to_owned())),
                (None, Some((_, body))) if line.starts_with('&') => *body += line.trim_end_matches("\\\\"),
                _ => (),
            }
        }
        Formula::of(definitions, inputs)
    }

    fn of(definitions: Vec<Definition>, inputs: HashMap<String, f64>) -> Formula {
        let names = definitions.iter().map(|(name, _)| name).chain(inputs.keys()).cloned().collect();
        Formula { definitions, names, inputs }
    }

    /// Returns the value of the first definition.
    pub fn value(&self) -> f64 {
        let (name, _) = self.definitions.first().expect("a definition");
        self.named(name, &mut HashMap::new())
    }

    fn named(&self, name: &str, known: &mut HashMap<String, f64>) -> f64 {
        if let Some(value) = self.inputs.get(name).or_else(|| known.get(name)) {
            return *value;
        }
        let (_, body) = self.definitions.iter().find(|(defined, _)| defined == name).unwrap_or_else(|| panic!("{name} is not defined"));
        let mut reader = Reader { formula: self, tokens: tokens(body, &self.names), at: 0, known, is_in_bars: false };
        let value = reader.chosen();
        assert_eq!(reader.at, reader.tokens.len(), "{body}: {:?}", reader.tokens);
        known.insert(name.to_owned(), value);
        value
    }
}

struct Reader<'a> {
    formula: &'a Formula,
    tokens: Vec<Token>,
    at: usize,
    known: &'a mut HashMap<String, f64>,
    /// `true` if the next bar closes one.
    is_in_bars: bool,
}

impl Reader<'_> {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at)
    }

    fn take(&mut self, token: &Token) -> bool {
        let is_there = self.peek() == Some(token);
        self.at += usize::from(is_there);
        is_there
    }

    fn expect(&mut self, sign: char) {
        assert!(self.take(&Token::Sign(sign)), "{sign:?} is missing at {} of {:?}", self.at, self.tokens);
    }

    /// Parses a sum, or one of several with conditions.
    fn chosen(&mut self) -> f64 {
        let mut found = None;
        loop {
            let value = self.sum();
            let holds = if self.take(&Token::If) {
                let less = self.sum();
                self.expect('<');
                let is_less = less < self.sum();
                self.expect(';');
                is_less
            } else {
                let _ = self.take(&Token::Otherwise);
                return found.unwrap_or(value);
            };
            found = found.or(holds.then_some(value));
        }
    }

    fn sum(&mut self) -> f64 {
        let mut value = if self.take(&Token::Sign('-')) { -self.product() } else { self.product() };
        loop {
            if self.take(&Token::Sign('+')) {
                value += self.product();
            } else if self.take(&Token::Sign('-')) {
                value -= self.product();
            } else {
                return value;
            }
        }
    }

    fn product(&mut self) -> f64 {
        let mut value = self.power();
        loop {
            match self.peek() {
                Some(Token::Sign('/')) => {
                    self.at += 1;
                    value /= self.power();
                }
                Some(Token::Sign('(' | 'F' | 'R' | '[')) | Some(Token::Number(_) | Token::Name(_) | Token::Function(_)) => {
                    value *= self.power()
                }
                Some(Token::Sign('|')) if !self.is_in_bars => value *= self.power(),
                _ => return value,
            }
        }
    }

    fn power(&mut self) -> f64 {
        let value = self.primary();
        if self.take(&Token::Sign('²')) { value * value } else { value }
    }

    fn group(&mut self) -> f64 {
        self.expect('{');
        let value = self.sum();
        self.expect('}');
        value
    }

    fn primary(&mut self) -> f64 {
        let token = self.peek().unwrap_or_else(|| panic!("more is expected behind {:?}", self.tokens)).clone();
        self.at += 1;
        match token {
            Token::Number(value) => value,
            Token::Name(name) => self.formula.named(&name, self.known),
            Token::Function("atan2") => {
                self.expect('(');
                let y = self.sum();
                self.expect(',');
                let x = self.sum();
                self.expect(')');
                y.atan2(x)
            }
            Token::Function(name) => {
                let argument = self.primary();
                match name {
                    "cos" => argument.cos(),
                    "sin" => argument.sin(),
                    _ => argument.sqrt(),
                }
            }
            Token::Sign('F') => {
                let numerator = self.group();
                numerator / self.group()
            }
            Token::Sign('R') => self.group().sqrt(),
            Token::Sign('[') => {
                let value = self.chosen();
                self.expect(']');
                value
            }
            Token::Sign('(') => {
                let is_in_bars = std::mem::replace(&mut self.is_in_bars, false);
                let value = self.sum();
                self.is_in_bars = is_in_bars;
                self.expect(')');
                value
            }
            Token::Sign('|') => {
                self.is_in_bars = true;
                let value = self.sum();
                self.is_in_bars = false;
                self.expect('|');
                value.abs()
            }
            other => panic!("{other:?} at {} of {:?}", self.at, self.tokens),
        }
    }
}

#[test]
fn formulas_are_read_as_people_do() {
    let inputs = || [("a", 3.0), ("b", -2.0), ("e", 0.5)].map(|(name, value)| (name.to_owned(), value)).into();
    for (text, value) in [
        ("x = −½ a (b + 1)", 1.5),
        ("x = a/b² + e a²", 5.25),
        ("x = y cos e\nwhere\n  y = (1 + e) a/(a b)\n      + |b e| a", 2.25 * 0.5_f64.cos()),
        ("x = 1\n      if a < b\n    2\n      otherwise", 2.0),
        ("x = 1\n      if b < a\n    2\n      otherwise", 1.0),
        ("x = atan2(a, −b)", 3_f64.atan2(2.0)),
    ] {
        assert_eq!(Formula::of_text(text, inputs()).value(), value, "{text}");
    }
    for (text, value) in [
        ("\\[\nx = -\\tfrac{1}{2} a \\left( b + 1 \\right)\n\\]", 1.5),
        ("x &= \\frac{a y}{b^{2}} \\\\\ny &= \\begin{cases} 1 & \\text{if } a < b \\\\ \\sqrt{4} & \\text{otherwise} \\end{cases}", 1.5),
        ("x &= \\left| b \\right| \\cos e", 2.0 * 0.5_f64.cos()),
    ] {
        assert_eq!(Formula::of_latex(text, inputs()).value(), value, "{text}");
    }
}
