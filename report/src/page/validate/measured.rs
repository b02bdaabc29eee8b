//! The measured tests: computed values, measured values and their differences.

use planar_impact_validation::{Coefficient, Frontal, Measured, Reading, RootMeanSquare, SmallOverlap, Worked};

use crate::block::{Block, Table};

/// Renders the second stage of the validation.
pub fn blocks(measured: &Measured) -> Vec<Block> {
    let mut blocks = vec![
        Block::Heading { level: 2, text: "Measured tests, which are not the paper's".to_owned() },
        Block::paragraph("Nothing is fitted here; an error is shown as it is, and the run fails when it is not the recorded one."),
    ];
    blocks.extend(small_overlap(&measured.small_overlap));
    blocks.extend(measured.frontal.iter().flat_map(frontal));
    blocks.extend(worked(&measured.worked));
    blocks
}

fn worked(all: &[Worked]) -> [Block; 2] {
    let row = |worked: &Worked| {
        let reading = &worked.reading;
        let record = reading.recorded.as_ref().map_or_else(|| "digits".to_owned(), |recorded| recorded.text().to_owned());
        vec![
            worked.example.clone(),
            reading.quantity.to_owned(),
            reading.unit.to_owned(),
            reading.measured.text().to_owned(),
            format!("{:.2}", reading.computed),
            format!("{:+.2}", reading.percent()),
            record,
        ]
    };
    [
        Block::paragraph(
            "Worked examples and staged collisions of the field. record: the error when a staged collision was added, in %; an example worked by hand \
             must come out to its digits.",
        ),
        Table::new(["example", "quantity", "unit", "published", "computed", "%", "record"], "lllrrrr", all.iter().map(row).collect())
            .into(),
    ]
}

fn small_overlap(tests: &[SmallOverlap]) -> Vec<Block> {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for test in tests {
        for (reading, other) in [(&test.delta_v, test.kudlich_slibar_delta_v), (&test.yaw_rate, test.kudlich_slibar_yaw_rate)] {
            rows.push(row(&test.test, reading, other));
        }
    }
    let [brach, other] = [SmallOverlap::root_mean_squares(tests), SmallOverlap::kudlich_slibar_root_mean_squares(tests)];
    for (quantity, brach, other) in [("delta-V", brach[0], other[0]), ("yaw rate", brach[1], other[1])] {
        rows.push(summary(quantity, brach, other));
    }
    let header = ["test", "quantity", "measured", "computed", "error", "%", "record", "K-S", "%"];
    let within = tests.iter().flat_map(|test| [&test.delta_v, &test.yaw_rate]).filter(|reading| reading.is_within_digits()).count();
    let mut blocks = vec![
        Block::paragraph(
            "IIHS small-overlap tests: a car against the edge of a fixed barrier, e, the share of mu_0 and Gamma as its authors fitted them; delta-V \
             in ft/s, clockwise yaw rate in deg/s. record: the error when the test was added, in %. K-S: the same by the tangential law of Kudlich \
             and Slibar.",
        ),
        Table::new(header, "llrrrrrrr", rows).narrow().into(),
    ];
    blocks.extend(tests.iter().map(|test| Block::item(format!(" {}: ", test.test), test.reason.as_str())));
    let digits = "lie within the digits of the measurement, the only uncertainty that is stated.";
    blocks.push(Block::item(" ", format!("{within} of the {} numbers {digits}", 2 * tests.len())));
    blocks
}

fn row(test: &str, reading: &Reading, other: f64) -> Vec<String> {
    vec![
        test.to_owned(),
        reading.quantity.to_owned(),
        reading.measured.text().to_owned(),
        format!("{:.2}", reading.computed),
        format!("{:+.2}", reading.error()),
        format!("{:+.2}", reading.percent()),
        reading.recorded.as_ref().map_or_else(|| "none".to_owned(), |recorded| recorded.text().to_owned()),
        format!("{other:.2}"),
        format!("{:+.2}", reading.percent_of(other)),
    ]
}

fn summary(quantity: &str, brach: RootMeanSquare, other: RootMeanSquare) -> Vec<String> {
    let cells = ["rms", quantity, "", "", "", "", "", "", ""].map(str::to_owned);
    let mut cells = cells.to_vec();
    cells[4] = format!("{:.2}", brach.error);
    cells[5] = format!("{:.2}", brach.percent);
    cells[7] = format!("{:.2}", other.error);
    cells[8] = format!("{:.2}", other.percent);
    cells
}

fn frontal(test: &Frontal) -> [Block; 4] {
    let row = |coefficient: &Coefficient| {
        let published = coefficient.published.as_ref().map_or_else(String::new, |published| published.text().to_owned());
        vec![coefficient.name.to_owned(), coefficient.unit.to_owned(), published, format!("{:.8}", Significant(coefficient.computed))]
    };
    let energy = &test.energy;
    let recorded = energy.recorded.as_ref().map_or_else(String::new, |recorded| format!(" (recorded {} %)", recorded.text()));
    let found = format!(
        "crush energy of the profile {:.0} J, kinetic energy {} J: {:+.0} J, {:+.2} %{recorded}; of the unevenness of the profile {:.0} J. With the \
         stiffness that the profile has exactly: {:+.2} %. The speed of the energy is {:.2} m/s, that of the test {} m/s.",
        energy.computed,
        energy.measured.text(),
        energy.error(),
        energy.percent(),
        test.unevenness,
        energy.percent_of(test.energy_by_profile),
        test.speed_of_crush,
        test.speed.text()
    );
    [
        Block::paragraph(format!(
            "NHTSA full-frontal test {}: {}, mean depth {:.4} m. From v = b0 + b1 C:",
            test.test, test.vehicle, test.mean_depth
        )),
        Table::new(["coefficient", "unit", "published", "computed"], "llrr", test.coefficients.iter().map(row).collect()).into(),
        Block::item(" ", found),
        Block::item(" reason: ", test.reason.as_str()),
    ]
}

/// Formats a number with as many significant digits as the precision of the format.
struct Significant(f64);

impl std::fmt::Display for Significant {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let whole = libm::log10(self.0.abs()).floor().clamp(0.0, 15.0) as usize + 1;
        write!(f, "{:.*}", f.precision().unwrap_or(8).saturating_sub(whole), self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::render;

    #[test]
    fn numbers_have_their_significant_digits() {
        let shown = |value| format!("{:.6}", Significant(value));
        assert_eq!([shown(29.837_452), shown(1_071_580.99), shown(0.5), shown(-79_010.705)], ["29.8375", "1071581", "0.50000", "-79010.7"]);
    }

    #[test]
    fn every_error_is_shown() {
        let measured = planar_impact_validation::run().expect("the tables can be read").measured;
        let text = render(&blocks(&measured));
        let worked = measured.worked.iter().map(|worked| (worked.example.as_str(), &worked.reading));
        for (test, reading) in measured.readings().chain(worked) {
            assert!(text.contains(test) && text.contains(&format!("{:+.2}", reading.percent())), "{test}\n{text}");
        }
        assert!(text.lines().all(|line| line.chars().count() <= 80), "80 columns");
    }
}
