//! Hashes of the structure of an expression. They ignore the order of terms and factors and all signs.

use num_rational::BigRational;

/// Hashes the magnitude of a number.
pub(super) fn of_magnitude(number: &BigRational) -> u64 {
    let digits = number.numer().magnitude().iter_u32_digits().chain([0]).chain(number.denom().magnitude().iter_u32_digits());
    digits.fold(11, |sum, digit| mix(sum ^ u64::from(digit)))
}

/// Hashes a text of a given kind.
pub(super) fn of_text(kind: u64, text: &str) -> u64 {
    text.bytes().fold(kind, |sum, byte| mix(sum ^ u64::from(byte)))
}

/// Applies the finishing step of the generator SplitMix64, which spreads each bit over all.
pub(super) fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::mix;

    #[test]
    fn the_finishing_step_is_that_of_splitmix64() {
        // The first numbers of the generator from the seed 1234567, as Rosetta Code lists them ("Pseudo-random numbers/Splitmix64").
        let state = |n: u64| 1_234_567_u64.wrapping_add(n.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        assert_eq!([0, 1, 2].map(|n| mix(state(n))), [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
    }
}
