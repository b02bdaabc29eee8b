//! The vector instructions of the machine, chosen while the program runs.

use multiversion::multiversion;
use multiversion::target::target_cfg_f;

/// A set of vector instructions. All give the same bits, unless a batch is [fast](super::Batch::fast).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Instructions {
    /// Those that the program was compiled for: SSE2 on x86-64, unless the compiler was told of more.
    Compiled,
    /// AVX2 with FMA, four numbers at a time.
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
            Instructions::Avx2 => std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma"),
            Instructions::Avx512 => std::arch::is_x86_feature_detected!("avx512f") && std::arch::is_x86_feature_detected!("avx512dq"),
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn is_available(self) -> bool {
        self == Instructions::Compiled
    }

    /// Returns `true` if they multiply and add in one operation; without it that is a call of a library, forty times slower.
    pub(crate) fn are_fused(self) -> bool {
        self != Instructions::Compiled || COMPILED_ARE_FUSED
    }

    /// Computes work with these instructions. A set that the machine has not gives way to one that it has.
    pub(crate) fn run(self, work: &mut impl Vectors) {
        match self {
            Instructions::Compiled => compiled(work),
            Instructions::Avx2 => avx2(work),
            Instructions::Avx512 => avx512(work),
        }
    }
}

const COMPILED_ARE_FUSED: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

/// Work that is compiled for each set of instructions.
pub(crate) trait Vectors {
    /// Whether it needs fused multiplication and addition. Such work is done by [sets](Instructions::are_fused) that have it, and compiled for no other.
    const FUSED: bool = false;

    /// Does the work. Everything below must be inlined: a function of its own would be compiled once, without vector instructions. Without optimization nothing is gained
    /// by it, and compiling the tests takes twice as long: hence `cfg_attr(not(debug_assertions), inline(always))` all over the kernel.
    fn compute(&mut self);
}

#[inline(never)]
fn compiled<W: Vectors>(work: &mut W) {
    if !W::FUSED || COMPILED_ARE_FUSED {
        work.compute();
    }
}

#[multiversion(targets("x86_64+avx2+fma"))]
fn avx2<W: Vectors>(work: &mut W) {
    if target_cfg_f!(target_feature = "avx2") { work.compute() } else { compiled(work) }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+fma"))]
fn avx512<W: Vectors>(work: &mut W) {
    if target_cfg_f!(target_feature = "avx512f") { work.compute() } else { compiled(work) }
}
