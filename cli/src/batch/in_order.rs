//! Parts of long work on several threads, written in the order in which they were read.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::thread;

/// Parts in the work for each thread: enough that none waits for the one that reads and writes.
const PARTS_A_THREAD: usize = 2;

/// Reads parts until there are no more, works on each on one of `threads`, and writes the results in order. It holds a few parts at a time.
///
/// # Errors
///
/// The first error of reading or writing, after which nothing more is read or written.
pub fn in_order<P: Send, A: Send, E>(
    threads: usize,
    mut read: impl FnMut() -> Result<Option<P>, E>,
    work: impl Fn(P) -> A + Sync,
    mut write: impl FnMut(A) -> Result<(), E>,
) -> Result<(), E> {
    thread::scope(|scope| {
        let (to_work, parts) = mpsc::channel::<(usize, P)>();
        let (done, answers) = mpsc::channel::<(usize, thread::Result<A>)>();
        let (parts, work) = (Arc::new(Mutex::new(parts)), &work);
        let started = (0..threads).take_while(|_| {
            let (parts, done) = (parts.clone(), done.clone());
            let worker = move || {
                loop {
                    let part = parts.lock().unwrap_or_else(PoisonError::into_inner).recv();
                    let Ok((i, part)) = part else { break };
                    if done.send((i, catch_unwind(AssertUnwindSafe(|| work(part))))).is_err() {
                        break;
                    }
                }
            };
            thread::Builder::new().spawn_scoped(scope, worker).is_ok()
        });
        // The system may allow fewer threads than are wanted, or none beside this one.
        let threads = started.count();
        drop((parts, done));
        if threads == 0 {
            while let Some(part) = read()? {
                write(work(part))?;
            }
            return Ok(());
        }
        let (mut sent, mut written, mut is_open) = (0, 0, true);
        let mut early: BTreeMap<usize, A> = BTreeMap::new();
        loop {
            while is_open && sent - written < PARTS_A_THREAD * threads {
                match read()? {
                    Some(part) => {
                        // Threads receive until there is no sender.
                        let _ = to_work.send((sent, part));
                        sent += 1;
                    }
                    None => is_open = false,
                }
            }
            if written == sent {
                return Ok(());
            }
            let Ok((i, answer)) = answers.recv() else { return Ok(()) };
            early.insert(i, answer.unwrap_or_else(|panic| resume_unwind(panic)));
            while let Some(answer) = early.remove(&written) {
                write(answer)?;
                written += 1;
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_in_order_and_parts_few() {
        for threads in [1, 2, 7] {
            let in_work = std::sync::atomic::AtomicUsize::new(0);
            let mut numbers = 0..1000_u64;
            let mut written = Vec::new();
            let read = || {
                in_work.fetch_add(1, std::sync::atomic::Ordering::SeqCst);
                Ok::<_, ()>(numbers.next())
            };
            let work = |number: u64| {
                // Uneven work, so that later parts are done first.
                thread::sleep(std::time::Duration::from_micros(number % 7 * 20));
                number * number
            };
            let write = |square| {
                assert!(in_work.fetch_sub(1, std::sync::atomic::Ordering::SeqCst) <= PARTS_A_THREAD * threads + 1);
                written.push(square);
                Ok(())
            };
            in_order(threads, read, work, write).expect("nothing fails");
            assert!(written.into_iter().eq((0..1000).map(|number| number * number)), "{threads} threads");
        }
    }

    #[test]
    fn the_first_error_ends_it() {
        let mut numbers = 0..;
        let read = || if numbers.start == 50 { Err("read") } else { Ok(numbers.next()) };
        assert_eq!(in_order(3, read, |number: i32| number, |_| Ok(())), Err("read"));
        let write = |number| if number == 20 { Err("write") } else { Ok(()) };
        let mut numbers = 0..;
        assert_eq!(in_order(3, || Ok(numbers.next()), |number: i32| number, write), Err("write"));
    }

    #[test]
    #[should_panic]
    fn a_panic_is_not_swallowed() {
        let mut numbers = 0..10;
        let _ = in_order(2, || Ok::<_, ()>(numbers.next()), |number: i32| assert!(number != 5), |()| Ok(()));
    }
}
