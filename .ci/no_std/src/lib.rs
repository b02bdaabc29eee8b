//! The library in a program without the standard library.

#![no_std]

use core::alloc::{GlobalAlloc, Layout};
use planar_impact::{Contact, Law, Nt};

struct NoMemory;

// SAFETY: it hands out nothing.
unsafe impl GlobalAlloc for NoMemory {
    unsafe fn alloc(&self, _: Layout) -> *mut u8 {
        core::ptr::null_mut()
    }
    unsafe fn dealloc(&self, _: *mut u8, _: Layout) {}
}

#[global_allocator]
static MEMORY: NoMemory = NoMemory;

#[panic_handler]
fn stop(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

/// The impulse that ends sliding, to be called from another language.
pub extern "C" fn critical_normal_impulse(contact: &Contact, restitution: f64) -> f64 {
    let Nt { n, .. } = contact.compliance.impulse_for(Law::Brach.change(contact.approach, restitution));
    n
}
