//! The words of every message that any test makes the program print: each run is compared with `reference/words.txt`, which is there to be read. A message that loses its
//! remedy, its place or a word is noticed here, whatever else its test compares. Numbers are `#`: they are the business of each test.
//!
//! After a change that is meant, run all tests with `UPDATE_WORDS=1`, which adds what is new, and read the difference; lines that nothing prints any longer go if the
//! file is removed first.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock, PoisonError};

use serde_json::Value;

const SEVERITIES: [&str; 3] = ["error: ", "warning: ", "note: "];

fn reference() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/words.txt")
}

/// A text with `#` for each number, and for its sign.
fn without_numbers(text: &str) -> String {
    let mut kept = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let after_sign = rest.strip_prefix('-').filter(|_| !kept.ends_with(|before: char| before.is_alphanumeric() || before == '#'));
        let unsigned = after_sign.unwrap_or(rest);
        if !unsigned.starts_with(|c: char| c.is_ascii_digit()) {
            kept.push(c);
            rest = &rest[c.len_utf8()..];
            continue;
        }
        kept.push('#');
        let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
        rest = &unsigned[digits(unsigned)..];
        if let Some(fraction) = rest.strip_prefix('.').filter(|fraction| digits(fraction) > 0) {
            rest = &fraction[digits(fraction)..];
        }
        if let Some(exponent) = rest.strip_prefix('e') {
            let exponent = exponent.strip_prefix(['-', '+']).unwrap_or(exponent);
            rest = if digits(exponent) > 0 { &exponent[digits(exponent)..] } else { rest };
        }
    }
    kept
}

/// The errors and notes on standard error, each on a line with its remedy.
fn of_errors(err: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let mut is_open = false;
    for line in err.lines() {
        if SEVERITIES.iter().any(|severity| line.starts_with(severity)) {
            found.push(line.to_owned());
            is_open = true;
        } else if let Some((_, help)) = line.split_once(" = help: ").filter(|_| is_open) {
            let last = found.last_mut().expect("a message is open");
            last.push_str(" | ");
            last.push_str(help);
        } else if line.is_empty() {
            is_open = false;
        }
    }
    found
}

/// The warnings and notes of a page, each on a line.
fn of_page(out: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let mut is_open = false;
    for line in out.lines() {
        let of = [("Warning: ", "warning: "), ("Note: ", "note: ")];
        if let Some((severity, text)) = of.iter().find_map(|(written, severity)| Some((severity, line.strip_prefix(written)?))) {
            found.push(format!("{severity}{text}"));
            is_open = true;
        } else if let Some(more) = line.strip_prefix("  ").filter(|_| is_open) {
            let last = found.last_mut().expect("a message is open");
            last.push(' ');
            last.push_str(more.trim_start());
        } else {
            is_open = false;
        }
    }
    found
}

/// The warnings and notes of an answer in JSON, each on a line.
fn of_answer(answer: &Value) -> Vec<String> {
    let message = |message: &Value| format!("{}: {}", message["severity"].as_str().unwrap_or("?"), message["text"].as_str().unwrap_or("?"));
    answer["messages"].as_array().into_iter().flatten().map(message).collect()
}

/// Text of the tests of hostile input, which is no word of the program.
fn is_hostile(message: &str) -> bool {
    message.contains("nnnnnnnn") || message.contains("U+")
}

/// Compares the messages of a run with those that were read.
pub fn compare(out: &str, err: &str) {
    static KNOWN: OnceLock<Mutex<BTreeSet<String>>> = OnceLock::new();
    let read = || Mutex::new(fs::read_to_string(reference()).unwrap_or_default().lines().map(str::to_owned).collect());
    let known = KNOWN.get_or_init(read);
    let temporary = format!("{}/planar-impact-test-0-0/", std::env::temp_dir().display());
    let answer = if out.starts_with('{') { serde_json::from_str(out).ok() } else { None };
    let mut messages = answer.map_or_else(|| of_page(out), |answer| of_answer(&answer));
    messages.extend(of_errors(err));
    let shown = |message: &String| without_numbers(message).trim_end_matches('.').replace(&without_numbers(&temporary), "");
    let messages = messages.iter().filter(|message| !is_hostile(message)).map(shown);
    let unknown: Vec<String> = {
        let known = known.lock().unwrap_or_else(PoisonError::into_inner);
        messages.filter(|message| !known.contains(message)).collect()
    };
    if unknown.is_empty() {
        return;
    }
    assert!(std::env::var_os("UPDATE_WORDS").is_some(), "words that {} has not: {unknown:#?}", reference().display());
    let mut known = known.lock().unwrap_or_else(PoisonError::into_inner);
    known.extend(unknown);
    let lines: String = known.iter().map(|line| format!("{line}\n")).collect();
    fs::write(reference(), lines).expect("written");
}
