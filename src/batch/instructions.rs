//! The vector instructions of the machine, chosen while the program runs.

use multiversion::multiversion;
use multiversion::target::target_cfg_f;

use super::tile::{Asked, Tile};

/// A set of vector instructions. All give the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Instructions {
    /// Those that the program was compiled for: SSE2 on x86-64, unless the compiler was told of more.
    Compiled,
    /// AVX2, four numbers at a time.
    Avx2,
    /// AVX-512, eight numbers at a time.
    Avx512,
}

impl Instructions {
    /// Returns the sets that this machine has, the best last.
    pub fn available() -> impl DoubleEndedIterator<Item = Instructions> {
        [Instructions::Compiled, Instructions::Avx2, Instructions::Avx512].into_iter().filter(|set| set.is_available())
    }

    /// Returns the best set that this machine has.
    pub fn best() -> Self {
        Instructions::available().next_back().unwrap_or(Instructions::Compiled)
    }

    #[cfg(target_arch = "x86_64")]
    fn is_available(self) -> bool {
        match self {
            Instructions::Compiled => true,
            Instructions::Avx2 => std::arch::is_x86_feature_detected!("avx2"),
            Instructions::Avx512 => std::arch::is_x86_feature_detected!("avx512f") && std::arch::is_x86_feature_detected!("avx512dq"),
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn is_available(self) -> bool {
        self == Instructions::Compiled
    }

    /// Computes a tile. A set that the machine has not gives way to one that it has.
    pub(super) fn evaluate(self, tile: &mut Tile, asked: Asked) {
        match self {
            Instructions::Compiled => compiled(tile, asked),
            Instructions::Avx2 => avx2(tile, asked),
            Instructions::Avx512 => avx512(tile, asked),
        }
    }
}

#[inline(never)]
fn compiled(tile: &mut Tile, asked: Asked) {
    tile.evaluate(asked);
}

#[multiversion(targets("x86_64+avx2"))]
fn avx2(tile: &mut Tile, asked: Asked) {
    if target_cfg_f!(target_feature = "avx2") { tile.evaluate(asked) } else { compiled(tile, asked) }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl"))]
fn avx512(tile: &mut Tile, asked: Asked) {
    if target_cfg_f!(target_feature = "avx512f") { tile.evaluate(asked) } else { compiled(tile, asked) }
}
