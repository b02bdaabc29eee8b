//! Collisions of a small generator, and one hash of the bits of everything that is computed of them. No standard library, no allocator.

use planar_impact::{Collision, CrushPlane, ForwardLeft, Heading, ImpulseRatio, Input, Law, Moment, Motion, Output, Party, Vehicle};

/// FNV-1a over the bits of numbers.
pub struct Hash(pub u64);

impl Hash {
    pub const START: Hash = Hash(0xcbf2_9ce4_8422_2325);

    pub fn number(&mut self, value: f64) {
        // The bits of a NaN are the machine's own; nothing that is computed here is one.
        self.bytes(&value.to_bits().to_le_bytes());
    }

    pub fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

/// SplitMix64.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let share = ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * share
    }
}

fn vehicle(random: &mut Random, facing: f64) -> Vehicle {
    let mass = random.between(800.0, 20_000.0);
    let heading = Heading::from_angle(facing + random.between(-1.0, 1.0));
    let speed = random.between(0.0, 35.0);
    Vehicle {
        mass,
        yaw_inertia: mass * random.between(1.0, 4.0),
        heading,
        impact_center: ForwardLeft { forward: random.between(-1.0, 2.5), left: random.between(-1.0, 1.0) },
        motion: Motion { velocity: heading.to_ground(ForwardLeft { forward: speed, left: 0.0 }), yaw_rate: random.between(-0.5, 0.5) },
    }
}

/// A collision by its number.
pub fn collision(number: u32) -> Collision {
    let mut random = Random(u64::from(number).wrapping_mul(0xd134_2543_de82_ef95));
    let facing = random.between(-3.0, 3.0);
    let one = vehicle(&mut random, facing);
    let two = vehicle(&mut random, facing + core::f64::consts::PI);
    Collision {
        one: one.into(),
        two: if number % 8 == 0 { Party::Barrier } else { two.into() },
        crush_plane: CrushPlane::from_angle(facing + random.between(-0.5, 0.5)),
        restitution: random.between(0.0, 0.4),
        impulse_ratio: match number % 3 {
            0 => ImpulseRatio::Critical,
            1 => ImpulseRatio::OfCritical(random.between(0.0, 1.0)),
            _ => ImpulseRatio::LimitedByFriction(random.between(0.0, 1.0)),
        },
        law: if number % 5 == 0 { Law::KudlichSlibar } else { Law::Brach },
        moment: Moment::None,
    }
}

/// Hashes every output of this many collisions, or the codes of the refusals, and returns how many are solved.
pub fn outputs(hash: &mut Hash, count: u32) -> u32 {
    let mut solved = 0;
    for number in 0..count {
        let collision = collision(number);
        match collision.solve() {
            Ok(impact) => {
                solved += 1;
                Output::ALL.into_iter().for_each(|output| hash.number(output.of(&collision, &impact)));
            }
            Err(refusals) => refusals.iter().for_each(|refusal| hash.bytes(refusal.code().as_bytes())),
        }
    }
    solved
}

/// Hashes the derivative of every output by every input.
pub fn derivatives(hash: &mut Hash, count: u32) {
    for number in 0..count {
        if let Ok(outputs) = collision(number).sensitivities() {
            for output in Output::ALL {
                Input::ALL.into_iter().for_each(|input| hash.number(outputs[output].by[input]));
            }
        }
    }
}
