//! Parses the number before a unit, and checks its range.

use super::{QuantityError, excerpt};

/// Reads a decimal number that an `f64` can hold: finite, and not rounded to zero.
///
/// # Errors
///
/// Returns an error if `text` is not a number, is not finite or too large, or is so small that it would become zero.
pub fn finite(text: &str) -> Result<f64, QuantityError> {
    let Ok(value) = text.parse::<f64>() else {
        let (digits, rest) = text.split_at(number_length(text));
        let is_separated = separated(digits, rest).filter(|_| digits.contains(|c: char| c.is_ascii_digit()));
        let message = || format!("{} is not a number", excerpt(text));
        return Err(is_separated.unwrap_or_else(|| QuantityError { message: message(), help: remedy(text) }));
    };
    let problem = if value.is_finite() {
        let mantissa = text.split(['e', 'E']).next().unwrap_or(text);
        let vanished = value == 0.0 && mantissa.contains(|c: char| ('1'..='9').contains(&c));
        if !vanished {
            return Ok(value);
        }
        "is too small: a 64-bit floating-point number would make it zero"
    } else if text.contains(|c: char| c.is_ascii_digit()) {
        "is too large for a 64-bit floating-point number"
    } else {
        "is not a finite number"
    };
    Err(QuantityError::new(format!("{} {problem}", excerpt(text))))
}

/// Splits `text` into its number and the rest, without the space between them.
///
/// # Errors
///
/// Returns an error if `text` does not begin with a number, with a hint for common ways of writing numbers.
pub(super) fn split(text: &str) -> Result<(f64, &str), QuantityError> {
    let length = number_length(text);
    let (digits, rest) = text.split_at(length);
    if !digits.contains(|c: char| c.is_ascii_digit()) {
        return Err(no_number(text));
    }
    if let Some(error) = separated(digits, rest) {
        return Err(error);
    }
    Ok((finite(digits)?, rest.trim_start()))
}

/// Returns the number of bytes of `text` taken by sign, digits, point and exponent. An `e` counts only if digits
/// follow it, so that a unit could begin with it.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let sign = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let mut end = sign(0);
    end += digits(end);
    if bytes.get(end) == Some(&b'.') {
        end += 1;
        end += digits(end);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let start = end + 1 + sign(end + 1);
        let exponent = digits(start);
        if exponent > 0 {
            end = start + exponent;
        }
    }
    end
}

/// Returns an error for a decimal comma or thousands separators after the digits.
fn separated(digits: &str, rest: &str) -> Option<QuantityError> {
    let separator = rest.chars().next().filter(|c| matches!(c, ',' | '_' | '\'' | '’') || c.is_whitespace())?;
    let mut groups = Vec::new();
    let mut tail = rest;
    while let Some(after) = tail.strip_prefix(separator) {
        let count = after.bytes().take_while(u8::is_ascii_digit).count();
        if count == 0 {
            break;
        }
        groups.push(&after[..count]);
        tail = &after[count..];
    }
    let are_thousands = !groups.is_empty() && groups.iter().all(|group| group.len() == 3);
    // A unit may begin with 1, as 1/s, and inches follow the mark of feet: 5'11".
    if !are_thousands && (separator.is_whitespace() || matches!(separator, '\'' | '’')) {
        return None;
    }
    let fraction = number_length(tail);
    let fraction = if tail.starts_with('.') { &tail[..fraction] } else { "" };
    let joined = format!("{digits}{}{fraction}", groups.concat());
    let name = if separator.is_whitespace() { "a space".to_owned() } else { format!("`{separator}`") };
    let message = format!("{name} has no place in the number of {}", excerpt(&format!("{digits}{rest}")));
    let help = match (separator, &groups[..]) {
        (',', [one]) if digits.contains('.') => format!("write {}.{one}", digits.replace('.', "")),
        (',', [one]) if are_thousands && fraction.is_empty() => format!("write {joined} or {digits}.{one}"),
        (',', [one]) if !are_thousands => format!("write {digits}.{one}"),
        _ => format!("write {joined}"),
    };
    Some(QuantityError::with_help(message, help))
}

fn no_number(text: &str) -> QuantityError {
    let word = text.trim_start_matches(['+', '-']).to_ascii_lowercase();
    if ["nan", "inf"].iter().any(|name| word.starts_with(name)) {
        return QuantityError::new(format!("{} is not a finite number", excerpt(text)));
    }
    if text.trim().is_empty() {
        return QuantityError::new("a number is missing".to_owned());
    }
    QuantityError { message: format!("{} does not begin with a number", excerpt(text)), help: remedy(text) }
}

/// Returns how to write what stands in place of a number.
fn remedy(text: &str) -> Option<String> {
    if text.starts_with(['−', '–']) {
        return Some("write an ordinary minus sign, `-`".to_owned());
    }
    let word = text.trim().to_ascii_lowercase();
    ["n/a", "na", "none", "null", "unknown", "?", "-"]
        .contains(&word.as_str())
        .then(|| "leave it out if it may be left out, and else give an estimate".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        match split(text) {
            Ok(read) => format!("read {read:?}"),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn numbers_and_rests() {
        assert_eq!(split("40ft/s"), Ok((40.0, "ft/s")));
        assert_eq!(split("-1.5e3 kg"), Ok((-1500.0, "kg")));
        assert_eq!(split("+.5m"), Ok((0.5, "m")));
        assert_eq!(split("5.e-1 m"), Ok((0.5, "m")));
        assert_eq!(split("0e-999 m"), Ok((0.0, "m"))); // zero stays zero
        assert_eq!(split("7 e"), Ok((7.0, "e")));
        assert_eq!(split("7e"), Ok((7.0, "e")));
        assert_eq!(split("1e-320"), Ok((1e-320, ""))); // subnormal, not zero
    }

    #[test]
    fn bad_numbers() {
        assert_eq!(message("nan m"), "`nan m` is not a finite number");
        assert_eq!(message("-inf"), "`-inf` is not a finite number");
        assert_eq!(message("1e999 m"), "`1e999` is too large for a 64-bit floating-point number");
        assert_eq!(message("1e-400 m"), "`1e-400` is too small: a 64-bit floating-point number would make it zero");
        assert_eq!(message("1,5 m"), "`,` has no place in the number of `1,5 m` (write 1.5)");
        assert_eq!(message("1,500 lb"), "`,` has no place in the number of `1,500 lb` (write 1500 or 1.500)");
        assert_eq!(message("1_500 lb"), "`_` has no place in the number of `1_500 lb` (write 1500)");
        assert_eq!(message("1,234,567.5 N"), "`,` has no place in the number of `1,234,567.5 N` (write 1234567.5)");
        assert_eq!(message("1,500.25 lb"), "`,` has no place in the number of `1,500.25 lb` (write 1500.25)");
        assert_eq!(message("2.564,5 kg"), "`,` has no place in the number of `2.564,5 kg` (write 2564.5)");
        assert_eq!(message("1 200 kg"), "a space has no place in the number of `1 200 kg` (write 1200)");
        assert_eq!(message("1\u{a0}200\u{a0}300 kg"), "a space has no place in the number of `1\u{a0}200\u{a0}300 kg` (write 1200300)");
        assert_eq!(message("1’500 lb"), "`’` has no place in the number of `1’500 lb` (write 1500)");
        assert_eq!(message("N/A"), "`N/A` does not begin with a number (leave it out if it may be left out, and else give an estimate)");
        assert_eq!(message("1'500 lb"), "`'` has no place in the number of `1'500 lb` (write 1500)");
        assert_eq!(split("3 1/s"), Ok((3.0, "1/s")));
        assert_eq!(split("5'11\""), Ok((5.0, "'11\"")));
        assert_eq!(message("ten ft"), "`ten ft` does not begin with a number");
        assert_eq!(message("−5 deg"), "`−5 deg` does not begin with a number (write an ordinary minus sign, `-`)");
        assert_eq!(message("."), "`.` does not begin with a number");
        assert_eq!(message(""), "a number is missing");
    }
}
