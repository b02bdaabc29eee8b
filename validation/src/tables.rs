//! The tables of the paper that are compared, and their numbers of cells.

use crate::{barrier, comparison, impulses, perpendicular, reconstruction};

/// A table before its text is read.
pub(crate) struct Expected {
    pub(crate) name: &'static str,
    /// Cells that are computed.
    pub(crate) computed: usize,
    /// Returns `true` for a computed cell, by row and column, that follows from others without further mechanics:
    /// copies, sums, ratios, unit conversions, components of a velocity, and ½ m v² or its root.
    pub(crate) derived: fn(row: &str, column: &str) -> bool,
    /// Cells that are not computed.
    pub(crate) given: usize,
    /// Description of those cells, and of those taken from another table.
    pub(crate) remark: &'static str,
}

/// The tables in the order of the paper. Test numbers and letters of positions are row labels, not cells.
pub(crate) const TABLES: [Expected; 8] = [
    Expected { name: perpendicular::TABLE_1, computed: 27 * 3, derived: |_, _| false, given: 27 * 3, remark: "v_1x, v_2y and e are given" },
    Expected {
        name: perpendicular::TABLE_2,
        computed: 13 * 3,
        // The row of Table 1 at (−40, 40), position A, e = 0.
        derived: |row, _| row == "0",
        given: 13,
        remark: "Γ is given",
    },
    Expected {
        name: impulses::TABLE_3,
        computed: 3 * 2,
        derived: |_, _| true,
        given: 3 * 3,
        remark: "the impulses on left, right and wing are measured",
    },
    Expected {
        name: impulses::TABLE_4,
        computed: 3,
        derived: |_, _| true,
        given: 3 * 2,
        remark: "the restitution by either method is measured",
    },
    Expected {
        name: comparison::TABLE_5,
        computed: 3 * 6,
        derived: |_, _| true,
        given: 0,
        remark: "no cell is given; all are those of Table B2",
    },
    Expected {
        name: comparison::TABLE_6,
        computed: 3 * 6,
        derived: |_, _| true,
        given: 0,
        remark: "no cell is given; all are those of Table 5 in other units",
    },
    Expected {
        name: barrier::TABLE_B1,
        computed: 6 * 11 + 6,
        // pdof is atan μ.
        derived: |_, column| ["e", "test_mu", "v_n", "v_t", "T_i", "T_L", "dv_mph", "pdof"].contains(&column),
        given: 6 + 3 + 3 * 2,
        remark: "v_i, and Ω and ΔV of the tests, are measured; e = 0 is given, the other e are Table 4's, μ of the tests is Table 3's",
    },
    Expected {
        name: reconstruction::TABLE_B2,
        computed: 98,
        // E_C sums T_Ln of Table B1; EES and E* of the tests are roots of it; the planar T_Ln is the crush energy, μ that of Table B1.
        derived: |_, column| {
            let test = ["v_i", "v_n", "v_t", "T_i", "e", "test_mu", "test_E_C", "test_EES", "test_E*"];
            let models = ["crash3_T_L", "crash3_dv_ftps", "crash3_dv_mph", "planar_T_Ln", "planar_T_L", "planar_mu", "planar_dv_mph"];
            test.contains(&column) || models.contains(&column)
        },
        given: 3 + 3,
        remark: "C_avg is measured; e = 0 is given; v_i is Table B1's, the other e are Table 4's, μ of the tests is Table 3's",
    },
];
