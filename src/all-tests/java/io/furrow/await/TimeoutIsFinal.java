package io.furrow.await;

import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import org.junit.jupiter.api.extension.BeforeAllCallback;
import org.junit.jupiter.api.extension.BeforeEachCallback;
import org.junit.jupiter.api.extension.ExtensionContext;
import org.junit.jupiter.api.extension.LifecycleMethodExecutionExceptionHandler;
import org.junit.jupiter.api.extension.PreInterruptCallback;
import org.junit.jupiter.api.extension.PreInterruptContext;
import org.junit.jupiter.api.extension.TestExecutionExceptionHandler;

/**
 * Fails the reruns of a test that timed out, because each would hang as long. Ends the JVM and its child processes if a test ignores the
 * interrupt, which Surefire's own timeout does not do (SUREFIRE-1722).
 */
public final class TimeoutIsFinal
        implements BeforeAllCallback,
                BeforeEachCallback,
                PreInterruptCallback,
                TestExecutionExceptionHandler,
                LifecycleMethodExecutionExceptionHandler {
    private static final int GRACE_SECONDS = 30;
    private static final Map<String, Throwable> TIMEOUTS = new ConcurrentHashMap<>();
    private static final Map<String, CountDownLatch> INTERRUPTED = new ConcurrentHashMap<>();

    /** Called by JUnit. */
    public TimeoutIsFinal() {}

    @Override
    public void beforeAll(ExtensionContext context) {
        failIfTimedOut(context);
    }

    @Override
    public void beforeEach(ExtensionContext context) {
        failIfTimedOut(context);
    }

    @Override
    public void beforeThreadInterrupt(PreInterruptContext interrupt, ExtensionContext context) {
        CountDownLatch returned = new CountDownLatch(1);
        INTERRUPTED.put(context.getUniqueId(), returned);
        Thread watchdog = new Thread(() -> haltUnless(returned, context.getUniqueId()), "interrupted-test-watchdog");
        watchdog.setDaemon(true);
        watchdog.start();
    }

    private static void haltUnless(CountDownLatch returned, String test) {
        try {
            if (!returned.await(GRACE_SECONDS, TimeUnit.SECONDS)) {
                System.err.println(test + " ignored the interrupt for " + GRACE_SECONDS + " s: ending this JVM");
                ProcessHandle.current().descendants().forEach(ProcessHandle::destroyForcibly);
                Runtime.getRuntime().halt(1);
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    @Override
    public void handleTestExecutionException(ExtensionContext context, Throwable failure) throws Throwable {
        throw record(context, failure);
    }

    @Override
    public void handleBeforeAllMethodExecutionException(ExtensionContext context, Throwable failure) throws Throwable {
        throw record(context, failure);
    }

    @Override
    public void handleBeforeEachMethodExecutionException(ExtensionContext context, Throwable failure) throws Throwable {
        throw record(context, failure);
    }

    @Override
    public void handleAfterEachMethodExecutionException(ExtensionContext context, Throwable failure) throws Throwable {
        throw record(context, failure);
    }

    @Override
    public void handleAfterAllMethodExecutionException(ExtensionContext context, Throwable failure) throws Throwable {
        throw record(context, failure);
    }

    private static Throwable record(ExtensionContext context, Throwable failure) {
        CountDownLatch returned = INTERRUPTED.remove(context.getUniqueId());
        if (returned != null) {
            returned.countDown();
        }
        // a timeout of JUnit, not of a future
        if (failure instanceof TimeoutException
                && String.valueOf(failure.getMessage()).contains(" timed out after ")) {
            TIMEOUTS.put(context.getUniqueId(), failure);
        }
        return failure;
    }

    private static void failIfTimedOut(ExtensionContext context) {
        Throwable timeout = TIMEOUTS.get(context.getUniqueId());
        if (timeout != null) {
            throw new IllegalStateException("Not run again: " + timeout.getMessage(), timeout);
        }
    }
}
