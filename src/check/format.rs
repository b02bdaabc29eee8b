//! Formatting of numbers in messages.

use core::fmt;

/// A number with six significant digits, or fewer if they are enough.
#[derive(Clone, Copy, Debug)]
pub(super) struct Digits(pub(super) f64);

impl fmt::Display for Digits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Digits(value) = *self;
        if value == 0.0 || !value.is_finite() {
            // Zero without a sign.
            return write!(f, "{}", value + 0.0);
        }
        let exponent = libm::floor(libm::log10(value.abs())) as i32;
        if !(-4..7).contains(&exponent) {
            return write!(f, "{value:.2e}");
        }
        let decimals = (5 - exponent).max(0) as usize;
        let text = alloc::format!("{value:.decimals$}");
        f.write_str(if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn six_digits_at_most() {
        let text = |value| Digits(value).to_string();
        assert_eq!(text(0.660_644_48), "0.660644");
        assert_eq!(text(-40_806.331), "-40806.3");
        assert_eq!(text(1200.0), "1200");
        assert_eq!(text(1_234_567.8), "1234568");
        assert_eq!(text(-0.0), "0");
        assert_eq!(text(3.2e-9), "3.20e-9");
        assert_eq!(text(12_345_678.0), "1.23e7");
        assert_eq!(text(f64::INFINITY), "inf");
        assert_eq!(text(0.000_12), "0.00012");
    }
}
