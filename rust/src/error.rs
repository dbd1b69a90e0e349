//! Errors, and the calls of C that make them.
use crate::geometry::BodyId;
use crate::sys;
use std::any::Any;
use std::ffi::CStr;
use std::fmt;
use std::os::raw::{c_char, c_void};
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::sync::{Mutex, PoisonError};

/// Why a call was refused. Nothing has changed then.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The number of `KS_ERROR_...` in `kinesphere.h`.
    pub status: i32,
    /// The name of the status, such as "stale_body".
    pub name: &'static str,
    /// The argument that is wrong, as C and C++ call it.
    pub argument: String,
    /// The body concerned.
    pub body: Option<BodyId>,
    /// One line for a person.
    pub message: String,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}
impl std::error::Error for Error {}

pub type Result<T> = std::result::Result<T, Error>;

/// Returns a text that lives as long as the program.
pub(crate) fn literal(text: *const c_char) -> &'static str {
    // The library returns literals here, in ASCII.
    unsafe { CStr::from_ptr(text) }.to_str().unwrap_or("")
}

/// Returns the error of a call that has just failed in this thread.
pub(crate) fn check(status: sys::ks_status) -> Result<()> {
    if status == sys::KS_OK {
        return Ok(());
    }
    let text = |text: *const c_char| unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned();
    unsafe {
        Err(Error {
            status,
            name: literal(sys::ks_status_name(status)),
            argument: text(sys::ks_last_error_argument()),
            body: sys::ks_last_error_body().some(),
            message: text(sys::ks_last_error_message()),
        })
    }
}

/// Calls `fill(elements, capacity, count)`, which writes all elements if they fit, until they do.
pub(crate) fn filled<T: Clone + Default>(
    mut fill: impl FnMut(*mut T, usize, *mut usize) -> sys::ks_status,
) -> Result<Vec<T>> {
    let mut elements = vec![T::default(); 16];
    loop {
        let mut count = 0;
        let status = fill(elements.as_mut_ptr(), elements.len(), &mut count);
        if status != sys::KS_ERROR_BUFFER_TOO_SMALL {
            check(status)?;
            elements.truncate(count);
            return Ok(elements);
        }
        elements.resize(count, T::default());
    }
}

/// A closure that C calls, and the panic that it ended with: a panic must not pass through C.
pub(crate) struct Guarded<F> {
    function: F,
    panic: Mutex<Option<Box<dyn Any + Send>>>,
}

impl<F> Guarded<F> {
    pub(crate) fn new(function: F) -> Guarded<F> {
        Guarded { function, panic: Mutex::new(None) }
    }
    /// What C passes to the callbacks.
    pub(crate) fn user(&mut self) -> *mut c_void {
        self as *mut Guarded<F> as *mut c_void
    }
    /// Calls `body(function)` in a callback, and returns its answer for C: 0, or 1 after a panic.
    ///
    /// # Safety
    /// `user` is that of a living object of this type, which no other thread uses.
    pub(crate) unsafe fn call(user: *mut c_void, body: impl FnOnce(&mut F)) -> i32 {
        let guarded = &mut *(user as *mut Guarded<F>);
        let function = &mut guarded.function;
        answer(&guarded.panic, || body(function))
    }
    /// The same for callbacks that several threads call at a time.
    ///
    /// # Safety
    /// `user` is that of a living object of this type.
    pub(crate) unsafe fn call_shared(user: *mut c_void, body: impl FnOnce(&F)) -> i32
    where
        F: Sync,
    {
        let guarded = &*(user as *const Guarded<F>);
        answer(&guarded.panic, || body(&guarded.function))
    }
    /// Continues the panic of a callback, once, after C has returned.
    pub(crate) fn resume(&self) {
        let panic = self.panic.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(panic) = panic {
            resume_unwind(panic);
        }
    }
}

fn answer(panic: &Mutex<Option<Box<dyn Any + Send>>>, body: impl FnOnce()) -> i32 {
    match catch_unwind(AssertUnwindSafe(body)) {
        Ok(()) => 0,
        Err(payload) => {
            *panic.lock().unwrap_or_else(PoisonError::into_inner) = Some(payload);
            1
        }
    }
}
