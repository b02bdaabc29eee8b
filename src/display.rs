//! Vehicles and impacts as aligned text in SI, for terminals and logs.
//!
//! The precision of the format is the number of decimals, three by default: `{impact:.1}`.

use core::fmt;

use crate::impact::{Impact, Response};
use crate::vehicle::{Motion, Party, Vehicle};

/// Writes a line: a label, numbers, and their unit.
fn line<T: fmt::Display>(f: &mut fmt::Formatter<'_>, label: &str, unit: &str, numbers: &[&T]) -> fmt::Result {
    let decimals = f.precision().unwrap_or(3);
    write!(f, "{label:<24}")?;
    for number in numbers {
        write!(f, "{number:>16.decimals$}")?;
    }
    if unit.is_empty() { Ok(()) } else { write!(f, "  {unit}") }
}

fn motion<T: fmt::Display>(f: &mut fmt::Formatter<'_>, motion: &Motion<T>) -> fmt::Result {
    line(f, "  velocity x, y", "m/s", &[&motion.velocity.x, &motion.velocity.y])?;
    writeln!(f)?;
    line(f, "  yaw rate", "rad/s", &[&motion.yaw_rate])
}

impl<T: fmt::Display> fmt::Display for Motion<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        motion(f, self)
    }
}

impl<T: fmt::Display> fmt::Display for Vehicle<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "vehicle")?;
        line(f, "  mass", "kg", &[&self.mass])?;
        writeln!(f)?;
        line(f, "  yaw inertia", "kg m^2", &[&self.yaw_inertia])?;
        writeln!(f)?;
        line(f, "  heading cos, sin", "", &[&self.heading.cos, &self.heading.sin])?;
        writeln!(f)?;
        line(f, "  impact center", "m", &[&self.impact_center.forward, &self.impact_center.left])?;
        writeln!(f)?;
        motion(f, &self.motion)
    }
}

impl<T: fmt::Display> fmt::Display for Party<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Party::Vehicle(vehicle) => vehicle.fmt(f),
            Party::Barrier => f.write_str("fixed barrier"),
        }
    }
}

impl<T: fmt::Display> fmt::Display for Response<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        motion(f, &self.after)?;
        writeln!(f)?;
        line(f, "  delta-V x, y", "m/s", &[&self.delta_v.x, &self.delta_v.y])
    }
}

impl<T: fmt::Display> fmt::Display for Impact<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, response) in [("vehicle 1 after", &self.one), ("vehicle 2 after", &self.two)] {
            writeln!(f, "{name}")?;
            response.fmt(f)?;
            writeln!(f)?;
        }
        writeln!(f, "contact, n and t")?;
        line(f, "  approach velocity", "m/s", &[&self.approach.n, &self.approach.t])?;
        writeln!(f)?;
        line(f, "  separation velocity", "m/s", &[&self.separation.n, &self.separation.t])?;
        writeln!(f)?;
        line(f, "  impulse on vehicle 1", "N s", &[&self.impulse.n, &self.impulse.t])?;
        writeln!(f)?;
        line(f, "  work", "J", &[&self.work.n, &self.work.t])?;
        writeln!(f)?;
        line(f, "kinetic energy", "J", &[&self.kinetic_energy.before, &self.kinetic_energy.after])
    }
}

#[cfg(test)]
mod tests {
    use crate::{Collision, Party, Vehicle};
    use alloc::string::{String, ToString};

    #[test]
    fn aligned_with_units() {
        let car = Vehicle::new(1500.0, 2500.0).with_impact_center(2.0, 0.0).with_speed(15.0);
        assert_eq!(
            format_lines(&car.to_string())[..3],
            ["vehicle", "  mass                          1500.000  kg", "  yaw inertia                   2500.000  kg m^2"]
        );
        assert_eq!(Party::<f64>::Barrier.to_string(), "fixed barrier");
        let impact = Collision::new(car, Party::Barrier).with_restitution(0.1).solve().expect("it closes");
        let text = alloc::format!("{impact:.1}");
        let lines = format_lines(&text);
        // Straight into a wall: −e v after it, an impulse of (1 + e) m v, and a loss of (1 − e²) of ½ m v².
        let numbers = |label: &str| -> alloc::vec::Vec<f64> {
            let line = lines.iter().find(|line| line.trim_start().starts_with(label)).expect("there is such a line");
            line[24..].split_whitespace().filter_map(|word| word.parse().ok()).collect()
        };
        assert_eq!(numbers("velocity x, y"), [-1.5, 0.0]);
        assert_eq!(numbers("impulse on vehicle 1"), [-24750.0, 0.0]);
        assert_eq!(numbers("kinetic energy"), [168_750.0, 1687.5]);
        assert!(lines.iter().all(|line| line.len() <= 80));
        assert_eq!(lines.iter().filter(|line| line.starts_with("  ")).count(), 10);
    }

    fn format_lines(text: &str) -> alloc::vec::Vec<String> {
        text.lines().map(String::from).collect()
    }
}
