//! Simulates collisions of car-sized boxes in Rapier and checks each against the laws of planar impact, to report what Rapier conserves.
//!
//! ```sh
//! cargo run --manifest-path examples/rapier/Cargo.toml
//! ```

mod collide;
mod tally;

use collide::{Pair, collide};
use planar_impact::check::{Options, check};
use std::io::{self, Write};
use tally::Tally;

/// Pairs drawn for each restitution and friction.
const PAIRS: u64 = 60;

fn main() -> io::Result<()> {
    let mut out = io::stdout().lock();
    writeln!(out, "Rapier at 960 steps a second, two boxes and no gravity, checked as a stepper.\n")?;
    writeln!(out, "{}", Tally::HEADER)?;
    for restitution in [0.0, 0.3, 0.7, 1.0] {
        for friction in [0.0, 0.4] {
            let mut tally = Tally::default();
            for seed in 0..PAIRS {
                match collide(&Pair::draw(seed, restitution, friction)) {
                    Some(record) => tally.add(&check(&record, &Options::default())),
                    None => tally.missed += 1,
                }
            }
            writeln!(out, "{}", tally.line(restitution, friction))?;
        }
    }
    writeln!(out, "\n{}", Tally::LEGEND)
}

#[cfg(test)]
mod tests {
    use super::*;
    use planar_impact::check::Rule;

    #[test]
    fn rapier_exchanges_linear_momentum() {
        let mut checked = 0;
        for seed in 0..20 {
            let Some(record) = collide(&Pair::draw(seed, 0.3, 0.4)) else { continue };
            let outcome = check(&record, &Options::default());
            assert!(outcome.has_checked(Rule::LinearMomentum));
            assert_eq!(outcome.of(Rule::LinearMomentum).count(), 0, "{outcome}");
            checked += 1;
        }
        assert!(checked > 10);
    }

    #[test]
    fn a_wrong_sign_does_not_pass() {
        let mut record = (0..20).find_map(|seed| collide(&Pair::draw(seed, 0.0, 0.0))).expect("some pair collides");
        let velocity = record.one.after.velocity.as_mut().expect("it is recorded");
        velocity.x = -velocity.x;
        assert!(check(&record, &Options::default()).of(Rule::LinearMomentum).next().is_some());
    }
}
