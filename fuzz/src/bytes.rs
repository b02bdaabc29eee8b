//! Choices that bytes make, and trees of values written as TOML and as JSON.

use arbitrary::Unstructured;

/// Bytes that are used up by choices; without any left every choice is the first.
pub struct Bytes<'a>(Unstructured<'a>);

impl<'a> Bytes<'a> {
    /// Starts with these bytes.
    pub fn new(data: &'a [u8]) -> Self {
        Bytes(Unstructured::new(data))
    }

    /// Returns a byte.
    pub fn byte(&mut self) -> u8 {
        self.0.arbitrary().unwrap_or(0)
    }

    /// Returns a number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        self.0.int_in_range(0..=end - 1).unwrap_or(0)
    }

    /// Returns one of these.
    pub fn one_of<T: Clone>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())].clone()
    }

    /// Returns `true` in `share` of 256 cases, never without bytes.
    pub fn chance(&mut self, share: u8) -> bool {
        let byte = self.byte();
        byte != 0 && byte <= share
    }

    /// Returns any float.
    pub fn float(&mut self) -> f64 {
        f64::from_bits(self.0.arbitrary().unwrap_or(0))
    }

    /// Returns a number of a range, mostly with few digits.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let share: u32 = self.0.arbitrary().unwrap_or(1 << 30);
        let value = low + (high - low) * (f64::from(share) / f64::from(u32::MAX));
        match self.byte() % 8 {
            0 => low,
            1 => high,
            2..=4 => (value * 100.0).round() / 100.0,
            _ => value,
        }
    }

    /// Returns a positive number of a range, every power of ten as likely as every other.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        let share: u32 = self.0.arbitrary().unwrap_or(1 << 30);
        let share = f64::from(share) / f64::from(u32::MAX);
        (low.ln() + (high.ln() - low.ln()) * share).exp().clamp(low, high)
    }

    /// Returns text that a person would not write.
    pub fn word(&mut self) -> String {
        const WORDS: [&str; 24] = [
            "",
            " ",
            "\0",
            "\u{1b}[31m",
            "1e999 m",
            "-1e400",
            "nan",
            "inf",
            "∞ m",
            "1 kg",
            "50 km/h ± 5 %",
            "± 1",
            "1 ±",
            "critical",
            "from crush",
            "true",
            "'",
            "\"\"\"",
            "{",
            "\u{202e}",
            "🚗",
            "0x10",
            "1_000 kg",
            "5 ft 2 in",
        ];
        if self.chance(200) {
            return self.one_of(&WORDS).to_owned();
        }
        let length = self.below(12);
        let bytes: Vec<u8> = (0..length).map(|_| self.byte()).collect();
        String::from_utf8_lossy(&bytes).into_owned()
    }

    /// Returns a value that a person would not write.
    pub fn junk(&mut self, depth: usize) -> Node {
        match self.below(if depth < 3 { 6 } else { 4 }) {
            0 => Node::Text(self.word()),
            1 => {
                Node::Number(self.one_of(&["0", "-1", "1", "1e308", "-1e308", "5e-324", "1e400", "9223372036854775807", "0.1"]).to_owned())
            }
            2 => Node::Number(format!("{:e}", Some(self.float()).filter(|x| x.is_finite()).unwrap_or(2.0))),
            3 => Node::Bool(self.chance(128)),
            4 => Node::List((0..self.below(4)).map(|_| self.junk(depth + 1)).collect()),
            _ => Node::Table((0..self.below(4)).map(|_| (self.key(), self.junk(depth + 1))).collect()),
        }
    }

    /// Returns a key, mostly one that a case file may have somewhere.
    pub fn key(&mut self) -> String {
        const KEYS: [&str; 26] = [
            "schema",
            "title",
            "vehicle",
            "contact",
            "mass",
            "weight",
            "barrier",
            "crush",
            "speed",
            "velocity",
            "yaw_inertia",
            "min",
            "max",
            "mode",
            "sd",
            "value",
            "file",
            "a.b",
            "1",
            "evidence",
            "unknown",
            "restitution",
            "relative",
            "resolution",
            "friction",
            "moment",
        ];
        if self.chance(230) { self.one_of(&KEYS).to_owned() } else { self.word() }
    }
}

/// A value of a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// A string.
    Text(String),
    /// A number as it is written.
    Number(String),
    /// `true` or `false`.
    Bool(bool),
    /// An array.
    List(Vec<Node>),
    /// A table, its keys in order.
    Table(Vec<(String, Node)>),
}

impl Node {
    /// A number with the digits that tell it from every other.
    pub fn number(value: f64) -> Node {
        Node::Number(if value == value.trunc() && value.abs() < 1e15 { format!("{value:.1}") } else { format!("{value:e}") })
    }

    /// A text.
    pub fn text(text: impl Into<String>) -> Node {
        Node::Text(text.into())
    }

    /// Returns it as JSON.
    pub fn json(&self) -> String {
        match self {
            Node::Text(text) => serde_json::Value::from(text.as_str()).to_string(),
            Node::Number(number) => number.clone(),
            Node::Bool(value) => value.to_string(),
            Node::List(items) => format!("[{}]", items.iter().map(Node::json).collect::<Vec<_>>().join(", ")),
            Node::Table(entries) => {
                let entry = |(key, node): &(String, Node)| format!("{}: {}", serde_json::Value::from(key.as_str()), node.json());
                format!("{{{}}}", entries.iter().map(entry).collect::<Vec<_>>().join(",\n "))
            }
        }
    }

    /// Returns it as TOML on one line.
    fn toml_inline(&self) -> String {
        match self {
            Node::Text(text) => quoted(text),
            Node::Number(number) => number.clone(),
            Node::Bool(value) => value.to_string(),
            Node::List(items) => format!("[{}]", items.iter().map(Node::toml_inline).collect::<Vec<_>>().join(", ")),
            Node::Table(entries) => {
                let entry = |(key, node): &(String, Node)| format!("{} = {}", quoted(key), node.toml_inline());
                format!("{{ {} }}", entries.iter().map(entry).collect::<Vec<_>>().join(", "))
            }
        }
    }

    /// Returns the entries of a table as a TOML document; tables and arrays of tables of the root under headers of their own if wanted.
    pub fn toml(&self, with_headers: bool) -> String {
        let Node::Table(entries) = self else { return self.toml_inline() };
        let (mut plain, mut headed) = (String::new(), String::new());
        let lines = |entries: &[(String, Node)]| -> String {
            entries.iter().map(|(key, node)| format!("{} = {}\n", quoted(key), node.toml_inline())).collect()
        };
        for (key, node) in entries {
            match node {
                Node::Table(inner) if with_headers => headed += &format!("[{}]\n{}", quoted(key), lines(inner)),
                Node::List(items) if with_headers && !items.is_empty() && items.iter().all(|item| matches!(item, Node::Table(_))) => {
                    for item in items {
                        let Node::Table(inner) = item else { continue };
                        headed += &format!("[[{}]]\n{}", quoted(key), lines(inner));
                    }
                }
                _ => plain += &lines(&[(key.clone(), node.clone())]),
            }
        }
        plain + &headed
    }
}

/// A string of TOML.
fn quoted(text: &str) -> String {
    let escaped: String = text
        .chars()
        .map(|c| match c {
            '"' | '\\' => format!("\\{c}"),
            c if c.is_control() => format!("\\u{:04x}", u32::from(c)),
            c => c.to_string(),
        })
        .collect();
    format!("\"{escaped}\"")
}
