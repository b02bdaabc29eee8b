//! Shares of the two vehicles in the crush energy.

/// Returns the share of vehicle 1 in two crush energies in J, or `None` if neither vehicle has any.
///
/// ```
/// use planar_impact::reconstruct::crush_share;
/// assert_eq!(crush_share(30e3, 10e3), Some(0.75));
/// assert_eq!(crush_share(0.0, 0.0), None);
/// ```
pub fn crush_share(one: f64, two: f64) -> Option<f64> {
    (one + two > 0.0).then(|| one / (one + two))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_of_the_sum() {
        assert_eq!([crush_share(30e3, 10e3), crush_share(0.0, 10e3), crush_share(0.0, 0.0)], [Some(0.75), Some(0.0), None]);
    }
}
