//! Arithmetic in six prime fields at once.

use core::ops::{Add, Mul, Neg, Sub};

use num_traits::FromPrimitive;
use rand::Rng;

use super::partial::{Partial, Ring};

const LANES: usize = 6;

/// 2⁶¹ minus each of the primes.
const BELOW: [u64; LANES] = [1, 31, 45, 229, 259, 283];

/// 2⁶¹ − 1 and the five primes before it.
///
/// Their product has 366 bits. A smaller integer that is a multiple of all six is zero, so residues determine
/// equalities of rational numbers.
pub const PRIMES: [u64; LANES] = {
    let mut primes = BELOW;
    let mut lane = 0;
    while lane < LANES {
        primes[lane] = (1 << 61) - BELOW[lane];
        lane += 1;
    }
    primes
};

/// The value of one expression modulo each of [`PRIMES`], or undefined once any of them divides by zero.
///
/// Each prime has its own point: the six computations share only their steps.
pub type Residues = Partial<Lanes>;

/// One residue modulo each of [`PRIMES`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lanes([u64; LANES]);

impl Lanes {
    /// Draws residues that are uniform and independent, to the extent that the generator's numbers are.
    pub fn draw(rng: &mut impl Rng) -> Self {
        Lanes(PRIMES.map(|prime| {
            loop {
                // 61 bits. A number not below the prime is drawn again, so that all residues are equally likely.
                let residue = rng.next_u64() >> 3;
                if residue < prime {
                    return residue;
                }
            }
        }))
    }

    fn each(self, other: Self, operation: impl Fn(u64, u64, usize) -> u64) -> Self {
        Lanes(core::array::from_fn(|lane| operation(self.0[lane], other.0[lane], lane)))
    }
}

/// Computes a product modulo 2⁶¹ − c: each multiple of 2⁶¹ is replaced by c.
fn product(a: u64, b: u64, lane: usize) -> u64 {
    let fold = |x: u128| (x & ((1 << 61) - 1)) + (x >> 61) * u128::from(BELOW[lane]);
    // Below 2¹²², then below 2⁷⁰, then below 2⁶¹ + 2¹⁸.
    let folded = fold(fold(u128::from(a) * u128::from(b))) as u64;
    if folded < PRIMES[lane] { folded } else { folded - PRIMES[lane] }
}

/// Computes the inverse by Fermat's little theorem: aᵖ⁻² a = 1.
fn inverse(a: u64, lane: usize) -> Option<u64> {
    let (mut power, mut square, mut exponent) = (1, a, PRIMES[lane] - 2);
    while exponent > 0 {
        if exponent & 1 == 1 {
            power = product(power, square, lane);
        }
        square = product(square, square, lane);
        exponent >>= 1;
    }
    (a != 0).then_some(power)
}

impl FromPrimitive for Lanes {
    fn from_i64(n: i64) -> Option<Self> {
        Some(Lanes(PRIMES.map(|prime| n.rem_euclid(prime as i64) as u64)))
    }

    fn from_u64(n: u64) -> Option<Self> {
        Some(Lanes(PRIMES.map(|prime| n % prime)))
    }
}

impl Neg for Lanes {
    type Output = Self;
    fn neg(self) -> Self {
        Lanes([0; LANES]) - self
    }
}

impl Add for Lanes {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.each(other, |a, b, lane| (a + b) % PRIMES[lane])
    }
}

impl Sub for Lanes {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.each(other, |a, b, lane| (a + (PRIMES[lane] - b)) % PRIMES[lane])
    }
}

impl Mul for Lanes {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.each(other, product)
    }
}

impl Ring for Lanes {
    fn inverse(self) -> Option<Self> {
        let mut inverses = self.0;
        for (lane, residue) in inverses.iter_mut().enumerate() {
            *residue = inverse(*residue, lane)?;
        }
        Some(Lanes(inverses))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_bigint::BigUint;
    use num_traits::Inv;
    use planar_impact::Field;
    use rand::SeedableRng;
    use rand::rngs::ChaCha20Rng;

    /// Tests primality by Lucas's theorem: a has order p − 1 if aᵖ⁻¹ = 1 and no a^((p − 1)/q) is 1, where q are the prime factors of p − 1.
    fn is_prime(p: u64) -> bool {
        let factors = {
            let (mut rest, mut factors, mut q) = (p - 1, Vec::new(), 2);
            while q * q <= rest {
                if rest % q == 0 {
                    factors.push(q);
                    while rest % q == 0 {
                        rest /= q;
                    }
                }
                q += 1;
            }
            if rest > 1 {
                factors.push(rest);
            }
            factors
        };
        let power = |a: u64, exponent: u64| BigUint::from(a).modpow(&exponent.into(), &p.into());
        let one = BigUint::from(1_u8);
        (2..100).any(|a| power(a, p - 1) == one && factors.iter().all(|q| power(a, (p - 1) / q) != one))
    }

    #[test]
    fn the_primes_are_prime() {
        assert!(is_prime(1_000_003) && !is_prime(1_000_001) && !is_prime(561));
        for prime in PRIMES {
            assert!(is_prime(prime), "{prime}");
        }
    }

    #[test]
    fn each_lane_is_a_field() {
        let mut rng = ChaCha20Rng::seed_from_u64(1);
        let extremes = [0, 1, -1, 2, i32::MIN, i32::MAX].map(Residues::int);
        let draws = [(); 20].map(|()| Residues::defined(Lanes::draw(&mut rng)));
        let elements = [&extremes[..], &draws[..]].concat();
        let (zero, one) = (Residues::int(0), Residues::int(1));
        for a in &elements {
            assert_eq!((*a + zero, *a * one, *a - *a), (*a, *a, zero));
            assert_eq!(*a + -*a, zero);
            if *a != zero {
                assert_eq!((*a * a.inv(), *a / *a), (one, one));
            }
            for b in &elements {
                assert_eq!((*a + *b, *a * *b), (*b + *a, *b * *a));
                assert_eq!(*a - *b, -(*b - *a));
                for c in &elements {
                    assert_eq!(((*a + *b) + *c, (*a * *b) * *c), (*a + (*b + *c), *a * (*b * *c)));
                    assert_eq!(*a * (*b + *c), *a * *b + *a * *c);
                }
            }
        }
        assert_eq!(zero.inv().value(), None);
        assert_eq!((one / zero).value(), None);
    }

    #[test]
    fn residues_are_those_of_the_integers() {
        let mut rng = ChaCha20Rng::seed_from_u64(2);
        for _ in 0..200 {
            let (a, b) = (Lanes::draw(&mut rng), Lanes::draw(&mut rng));
            for (lane, prime) in PRIMES.into_iter().enumerate() {
                let by = |operation: fn(u128, u128) -> u128| (operation(a.0[lane].into(), b.0[lane].into()) % u128::from(prime)) as u64;
                assert_eq!((a * b).0[lane], by(|a, b| a * b));
                assert_eq!((a + b).0[lane], by(|a, b| a + b));
                assert!(a.0[lane] < prime && (a - b).0[lane] < prime);
            }
        }
        let largest = Lanes(PRIMES.map(|prime| prime - 1));
        assert_eq!(largest * largest, Lanes([1; LANES]));
        assert_eq!(Residues::int(-3) + Residues::int(3), Residues::int(0));
        assert_eq!(Lanes::from_u64(u64::MAX), Some(Lanes(PRIMES.map(|prime| u64::MAX % prime))));
    }

    #[test]
    fn a_zero_in_one_lane_is_a_division_by_zero() {
        let with_a_zero = Lanes([3, 5, 0, 7, 11, 13]);
        assert_eq!(Residues::defined(with_a_zero).inv().value(), None);
    }
}
