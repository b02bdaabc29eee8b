//! The page of `validate`: the paper's tables compared with computed values, cell by cell.

pub(crate) mod measured;

use planar_impact_app::validate::Validation;
use planar_impact_validation::{Cell, Link, Statement, TableReport, Verdict};

use crate::block::{Block, Table};

/// Renders tables, statements in words, the chain of misprints, and the measured tests.
pub fn page(answer: &Validation) -> Vec<Block> {
    let report = &answer.report;
    let heading = |text: &str| Block::Heading { level: 2, text: text.to_owned() };
    let mut blocks = vec![Block::Heading { level: 1, text: "The tables of the paper, as printed and as computed".to_owned() }];
    blocks.extend(report.tables.iter().flat_map(cells));
    blocks.push(heading("Statements of the paper in words"));
    blocks.extend(report.statements.iter().flat_map(in_words));
    blocks.push(heading("The chain of misprints"));
    blocks.extend(report.chain.iter().flat_map(in_the_chain));
    blocks.extend(measured::blocks(&report.measured));
    blocks.extend(report.problems().iter().map(|problem| Block::item("Problem: ", problem.to_string())));
    blocks.push(Block::paragraph(report.summary()));
    blocks
}

fn cells(table: &TableReport) -> Vec<Block> {
    let mut reasons = Vec::new();
    let rows: Vec<Vec<String>> = table.cells.iter().map(|cell| row(cell, &mut reasons)).collect();
    let counts = table.counts();
    let counts = format!(
        "{} cells: {} agree to the last digit, {} within a bound, {} misprinted, {} given or measured",
        counts.total(),
        counts.agree,
        counts.within_bound,
        counts.misprints,
        counts.given
    );
    let mut blocks = vec![
        Block::Heading { level: 3, text: format!("{}, {counts}", table.name) },
        Table::new(["row", "column", "printed", "computed", "verdict"], "llrrl", rows).into(),
    ];
    blocks.extend(reasons.into_iter().enumerate().map(|(i, reason)| Block::item(format!(" [{}] ", i + 1), reason)));
    blocks.push(Block::item(" not computed: ", table.remark));
    blocks
}

fn row(cell: &Cell, reasons: &mut Vec<String>) -> Vec<String> {
    let note = match &cell.verdict {
        Verdict::WithinBound { reason, .. } => mark(reasons, reason),
        Verdict::Misprint { holds, why } => mark(reasons, &format!("printed {}; {} holds: {why}", cell.printed.text(), holds.text())),
        _ => String::new(),
    };
    vec![
        cell.row.clone(),
        cell.column.to_owned(),
        cell.printed.text().to_owned(),
        computed(cell),
        format!("{} {note}", cell.verdict.name()).trim_end().to_owned(),
    ]
}

/// Returns the footnote mark of a reason, which several cells may share.
fn mark(reasons: &mut Vec<String>, reason: &str) -> String {
    let at = reasons.iter().position(|known| known == reason).unwrap_or_else(|| {
        reasons.push(reason.to_owned());
        reasons.len() - 1
    });
    format!("[{}]", at + 1)
}

/// Formats a computed value with one digit more than the printed one.
fn computed(cell: &Cell) -> String {
    let decimals = cell.printed.text().split_once('.').map_or(0, |(_, decimals)| decimals.len());
    format!("{:.*}", decimals + 1, cell.computed)
}

fn in_the_chain(link: &Link) -> [Block; 2] {
    let printed = if link.printed == link.holds { link.printed.clone() } else { format!("{} ({} holds)", link.printed, link.holds) };
    [Block::paragraph(format!("{}: {printed}", link.place)), Block::item("    follows: ", link.how.as_str())]
}

fn in_words(statement: &Statement) -> [Block; 2] {
    [
        Block::paragraph(format!("{}: {}", statement.place, statement.says)),
        Block::item(format!("    {}: ", statement.standing.name()), statement.found.as_str()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::render;

    #[test]
    fn cells_of_one_reason_share_its_mark() {
        let mut reasons = Vec::new();
        let marks = ["a", "b", "a", "c", "b"].map(|reason| mark(&mut reasons, reason));
        assert_eq!(marks, ["[1]", "[2]", "[1]", "[3]", "[2]"]);
        assert_eq!(reasons, ["a", "b", "c"]);
    }

    #[test]
    fn every_cell_and_every_misprint_is_shown() {
        let answer = planar_impact_app::validate::validate(&(), &planar_impact_app::Uncontrolled).expect("the tables can be read");
        let (report, text) = (&answer.report, render(&page(&answer)));
        assert!(report.holds());
        for table in &report.tables {
            assert!(text.contains(&format!("{}, {} cells: ", table.name, table.printed_cells)));
        }
        assert!(text.contains("-21631.2; -21639.2 holds"), "the misprint of Table 2");
        assert!(text.contains("49197.30; 43197.30 holds"), "the misprint of Table B1");
        assert!(text.contains("61334 (51334 holds)") && text.contains("83.3 (69.6 holds)"), "the chain");
        assert!(text.lines().all(|line| line.chars().count() <= 80), "80 columns");
        assert!(!text.contains("Problem"));
    }
}
