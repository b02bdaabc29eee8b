//! Prints the hashes of the first two parts, of fewer collisions, through the debugger.
#![no_std]
#![no_main]

#[path = "../../src/collisions.rs"]
mod collisions;

use collisions::{Hash, derivatives, outputs};
use cortex_m_semihosting::{debug, hprintln};

const COUNT: u32 = 10_000;

#[panic_handler]
fn stop(_: &core::panic::PanicInfo<'_>) -> ! {
    debug::exit(debug::EXIT_FAILURE);
    loop {}
}

#[cortex_m_rt::entry]
fn main() -> ! {
    let (mut of_outputs, mut of_derivatives) = (Hash::START, Hash::START);
    outputs(&mut of_outputs, COUNT);
    derivatives(&mut of_derivatives, COUNT / 10);
    hprintln!("{:016x} {:016x}", of_outputs.0, of_derivatives.0);
    debug::exit(debug::EXIT_SUCCESS);
    loop {}
}
