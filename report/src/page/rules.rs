//! The page of `check --rules`.

use planar_impact_app::check::rules::Rules;

use crate::block::Block;

/// Renders every rule with its meaning, its condition and its law.
pub fn page(rules: &Rules) -> Vec<Block> {
    let mut blocks = vec![Block::paragraph("The rules, each with what breaking it means, what must hold, and the law.")];
    for rule in &rules.rules {
        blocks.push(Block::paragraph(format!("{} ({}): {}", rule.name, rule.severity, rule.help)));
        blocks.extend(rule.is_law.then(|| Block::item("    ", rule.law)));
    }
    blocks
}
