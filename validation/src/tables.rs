//! The tables of the paper that are held to account, and how many cells each of them has.

use crate::{barrier, comparison, impulses, perpendicular, reconstruction};

/// What is known of a table before its text is read.
pub(crate) struct Expected {
    pub(crate) name: &'static str,
    /// Cells that are computed.
    pub(crate) computed: usize,
    /// Cells that nothing computes.
    pub(crate) given: usize,
    /// Which ones those are, and which are taken over from another table.
    pub(crate) remark: &'static str,
}

/// In the order of the paper. The number of a test and the letter of a position are labels of their rows, and no cells.
pub(crate) const TABLES: [Expected; 8] = [
    Expected { name: perpendicular::TABLE_1, computed: 27 * 3, given: 27 * 3, remark: "v_1x, v_2y and e are given" },
    Expected { name: perpendicular::TABLE_2, computed: 13 * 3, given: 13, remark: "Γ is given" },
    Expected { name: impulses::TABLE_3, computed: 3 * 2, given: 3 * 3, remark: "the impulses on left, right and wing are measured" },
    Expected { name: impulses::TABLE_4, computed: 3, given: 3 * 2, remark: "the restitution by either method is measured" },
    Expected { name: comparison::TABLE_5, computed: 3 * 6, given: 0, remark: "no cell is given; all are those of Table B2" },
    Expected { name: comparison::TABLE_6, computed: 3 * 6, given: 0, remark: "no cell is given; all are those of Table 5 in other units" },
    Expected {
        name: barrier::TABLE_B1,
        computed: 6 * 11 + 6,
        given: 6 + 3 + 3 * 2,
        remark: "v_i, and Ω and ΔV of the tests, are measured; e = 0 is given, the other e are Table 4's, μ of the tests is Table 3's",
    },
    Expected {
        name: reconstruction::TABLE_B2,
        computed: 98,
        given: 3 + 3,
        remark: "C_avg is measured; e = 0 is given; v_i is Table B1's, the other e are Table 4's, μ of the tests is Table 3's",
    },
];
