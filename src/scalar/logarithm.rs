//! The natural logarithm of f64 without a branch, so that a loop over many numbers becomes one over vectors, with the bits of `libm`.
//!
//! The algorithm and its constants are those of FDLIBM (Sun Microsystems, 1993: `e_log.c`), as `libm` has them: the error is below one unit of the last place.

// The constants have the digits of their source, one or two more than an f64 keeps.
#![allow(clippy::excessive_precision)]

/// ln 2 in two parts; a multiple of up to 2¹¹ of the first is exact.
const LN_2: [f64; 2] = [6.931_471_803_691_238_164_90e-1, 1.908_214_929_270_587_700_02e-10];

const LOG: [f64; 7] = [
    6.666_666_666_666_735_13e-1,
    3.999_999_999_940_941_908e-1,
    2.857_142_874_366_239_149e-1,
    2.222_219_843_214_978_396e-1,
    1.818_357_216_161_805_012e-1,
    1.531_383_769_920_937_332e-1,
    1.479_819_860_511_658_591e-1,
];

const MANTISSA: u64 = (1 << 52) - 1;

/// The bits of √½, about; the significand that remains is between it and √2.
const ROOT_OF_HALF: u64 = 0x3fe6_a09e << 32;

/// 2⁵²: its last bits are a whole number.
const WHOLE: u64 = 0x433 << 52;

/// Returns the natural logarithm of a normal float above zero.
#[inline]
pub(crate) fn of_normal(x: f64) -> f64 {
    // x = 2ᵏ (1 + f)
    let bits = x.to_bits() + (1.0_f64.to_bits() - ROOT_OF_HALF);
    let k = f64::from_bits(WHOLE | (bits >> 52)) - (f64::from_bits(WHOLE) + 1023.0);
    let f = f64::from_bits((bits & MANTISSA) + ROOT_OF_HALF) - 1.0;
    let half_square = 0.5 * f * f;
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let even = w * (LOG[1] + w * (LOG[3] + w * LOG[5]));
    let odd = z * (LOG[0] + w * (LOG[2] + w * (LOG[4] + w * LOG[6])));
    s * (half_square + (odd + even)) + k * LN_2[1] - half_square + f + k * LN_2[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_has_the_bits_of_libm() {
        let about_powers = (-1022..=1023).map(|k| libm::exp2(f64::from(k))).flat_map(|x| [x, x.next_up(), x * 1.414, x * 1.4143]);
        let spread = (1..100_000).map(|i| f64::from(i) / 100_000.0);
        for x in about_powers.chain(spread).chain([f64::MIN_POSITIVE, f64::MAX, 1.0_f64.next_down()]) {
            assert_eq!(of_normal(x).to_bits(), libm::log(x).to_bits(), "{x:e}");
        }
    }
}
