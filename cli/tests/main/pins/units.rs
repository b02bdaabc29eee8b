//! Units by definition, and numbers as printed on a page.

use std::f64::consts::PI;

use serde_json::Value;

/// Definitions of the international pound, foot, inch and mile, and the standard acceleration of free fall (NIST SP 811, appendix B).
const POUND: f64 = 0.453_592_37;
const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;
const MILE: f64 = 1609.344;
const FREE_FALL: f64 = 9.806_65;
const POUND_FORCE: f64 = POUND * FREE_FALL;

/// Returns the size of a unit in SI. A foot pound is a unit of energy.
pub fn unit(name: &str) -> f64 {
    match name {
        "" | "m/s" | "m" | "kg" | "rad" | "rad/s" | "N s" | "N m s" | "J" | "kg m^2" | "N" | "N/m" | "N/m^2" | "N^0.5" | "N^0.5/m" => 1.0,
        "ft/s" | "ft" => FOOT,
        "in" => INCH,
        "cm" => 0.01,
        "mph" => MILE / 3600.0,
        "km/h" => 1.0 / 3.6,
        "deg" | "deg/s" => PI / 180.0,
        "lb" => POUND,
        "slug" => POUND_FORCE / FOOT,
        "lbf" | "lbf s" => POUND_FORCE,
        "ft lb" | "lbf s ft" | "lbf s^2 ft" => POUND_FORCE * FOOT,
        "lbf/in" => POUND_FORCE / INCH,
        "lbf/in^2" => POUND_FORCE / (INCH * INCH),
        "lbf^0.5" => POUND_FORCE.sqrt(),
        "lbf^0.5/ft" => POUND_FORCE.sqrt() / FOOT,
        "kN" => 1e3,
        "%" => 0.01,
        _ => panic!("no unit {name:?} is known here"),
    }
}

/// Parses a printed number; returns its value and half a unit of its last digit.
pub fn printed(cell: &str) -> Option<(f64, f64)> {
    let plain = cell.trim_start_matches('+');
    let value: f64 = plain.parse().ok().filter(|value: &f64| value.is_finite())?;
    let (digits, power) = plain.split_once('e').map_or((plain, 0), |(digits, power)| (digits, power.parse().expect("a power of ten")));
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len() as i32);
    Some((value, 0.5 * 10_f64.powi(power - decimals)))
}

/// Parses a printed number in which trailing zeros of a whole number are not significant.
pub fn rounded(cell: &str) -> Option<(f64, f64)> {
    let (value, half) = printed(cell)?;
    let zeros = if cell.contains('.') || value == 0.0 { 0 } else { cell.len() - cell.trim_end_matches('0').len() };
    Some((value, half * 10_f64.powi(zeros as i32)))
}

/// Checks a printed number against an SI value, to the digits printed. A number that is not negligible relative to
/// `scale` has at least two digits.
pub fn hold(cell: &str, si: f64, name: &str, scale: f64, what: &str) {
    let (value, half) = printed(cell).unwrap_or_else(|| panic!("{what}: {cell:?} is no number, where {si} {name} is expected"));
    let want = si / unit(name);
    if value == 0.0 {
        assert!(si.abs() <= 1e-9 * scale, "{what}: 0 for {si}");
        return;
    }
    assert!((value - want).abs() <= half * (1.0 + 1e-6) + 1e-12 * want.abs(), "{what}: {cell} {name} for {want}");
    assert!(half <= 0.05 * value.abs() * (1.0 + 1e-9), "{what}: {cell} has no two digits");
}

/// Checks a printed number against a value of a document.
pub fn hold_value(cell: &str, si: &Value, name: &str, scale: f64, what: &str) {
    hold(cell, si.as_f64().unwrap_or_else(|| panic!("{what}: {si} is no number")), name, scale, what);
}

/// A table of a page: its header, and the cells of its rows.
pub struct Table {
    pub head: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

fn cells(line: &str) -> Vec<String> {
    line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).map(str::to_owned).collect()
}

/// Returns every table of a page: a header above a line of dashes, and the rows below it.
pub fn tables(page: &str) -> Vec<Table> {
    let lines: Vec<&str> = page.lines().collect();
    let is_rule = |line: &str| line.len() > 8 && line.chars().all(|c| c == '-');
    let rules = lines.iter().enumerate().filter(|(_, line)| is_rule(line)).map(|(at, _)| at);
    rules
        .map(|at| {
            let rows = lines[at + 1..].iter().take_while(|line| !line.is_empty() && cells(line).len() > 1);
            Table { head: cells(lines[at - 1]), rows: rows.map(|line| cells(line)).collect() }
        })
        .collect()
}

#[test]
fn printed_numbers_are_held_to_their_digits() {
    assert_eq!(printed("-12.30"), Some((-12.3, 0.5 * 10_f64.powi(-2))));
    assert_eq!((printed("30100"), rounded("30100")), (Some((30100.0, 0.5)), Some((30100.0, 50.0))));
    assert_eq!(printed("+1.5e9"), Some((1.5e9, 0.5 * 1e8)));
    assert_eq!([printed("fixed"), printed("-"), printed("NaN")], [None; 3]);
    let refused = |cell: &str, si: f64| std::panic::catch_unwind(|| hold(cell, si, "ft/s", 1.0, "")).is_err();
    assert!(!refused("40.00", 12.192) && !refused("40.00", 12.1934) && !refused("0", 1e-15));
    assert!(refused("40.00", 12.194) && refused("-40.00", 12.192) && refused("0", 0.1) && refused("4", 1.2));
    let found = tables("a\n\n x   unit  y\n-------------\n p q   ft    1\n       m     2\n\nrest");
    assert_eq!((found.len(), found[0].head.join("|"), found[0].rows[1].join("|")), (1, "x|unit|y".to_owned(), "m|2".to_owned()));
}
