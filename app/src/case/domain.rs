//! Accepted values of the numbers in a case file.

/// The accepted values of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// Any number.
    Any,
    /// Numbers above zero.
    Positive,
    /// Zero and above.
    NotNegative,
    /// From 0 to 1.
    Fraction,
}

impl Domain {
    /// Describes the accepted values if `value` is outside them; returns `None` if it is inside.
    pub fn wanted(self, value: f64) -> Option<&'static str> {
        match self {
            Domain::Positive if value <= 0.0 => Some("above zero"),
            Domain::NotNegative if value < 0.0 => Some("at least 0"),
            Domain::Fraction if !(0.0..=1.0).contains(&value) => Some("from 0 to 1"),
            _ => None,
        }
    }

    /// Returns the least and the greatest of the accepted floats.
    pub fn limits(self) -> [f64; 2] {
        match self {
            Domain::Any => [f64::MIN, f64::MAX],
            Domain::Positive => [0_f64.next_up(), f64::MAX],
            Domain::NotNegative => [0.0, f64::MAX],
            Domain::Fraction => [0.0, 1.0],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn domains() {
        assert_eq!(Domain::Positive.wanted(0.0), Some("above zero"));
        assert_eq!(Domain::Fraction.wanted(1.0), None);
        assert_eq!(Domain::Fraction.wanted(1.1), Some("from 0 to 1"));
        assert_eq!(Domain::NotNegative.wanted(-0.1), Some("at least 0"));
        assert_eq!(Domain::Any.wanted(-1e9), None);
        for domain in [Domain::Any, Domain::Positive, Domain::NotNegative, Domain::Fraction] {
            for value in [f64::MIN, -1.0, -0.0, 0.0, 5e-324, 0.5, 1.0, 1.0_f64.next_up(), f64::MAX] {
                let [least, greatest] = domain.limits();
                assert_eq!((least..=greatest).contains(&value), domain.wanted(value).is_none(), "{domain:?} {value}");
            }
        }
    }
}
