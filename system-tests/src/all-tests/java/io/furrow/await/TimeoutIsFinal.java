package io.furrow.await;

import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.TimeoutException;

import org.junit.jupiter.api.extension.BeforeAllCallback;
import org.junit.jupiter.api.extension.BeforeEachCallback;
import org.junit.jupiter.api.extension.ExtensionContext;
import org.junit.jupiter.api.extension.LifecycleMethodExecutionExceptionHandler;
import org.junit.jupiter.api.extension.TestExecutionExceptionHandler;

/** A test that JUnit has ended because it hung is not run again: each further run would hang as long. */
public final class TimeoutIsFinal
        implements BeforeAllCallback,
                BeforeEachCallback,
                TestExecutionExceptionHandler,
                LifecycleMethodExecutionExceptionHandler {
    private static final Map<String, Throwable> TIMEOUTS = new ConcurrentHashMap<>();

    /** Made by JUnit. */
    public TimeoutIsFinal() {}

    @Override
    public void beforeAll(ExtensionContext context) {
        refuse(context);
    }

    @Override
    public void beforeEach(ExtensionContext context) {
        refuse(context);
    }

    @Override
    public void handleTestExecutionException(ExtensionContext context, Throwable failure) throws Throwable {
        throw noted(context, failure);
    }

    @Override
    public void handleBeforeAllMethodExecutionException(ExtensionContext context, Throwable failure) throws Throwable {
        throw noted(context, failure);
    }

    @Override
    public void handleBeforeEachMethodExecutionException(ExtensionContext context, Throwable failure) throws Throwable {
        throw noted(context, failure);
    }

    private static Throwable noted(ExtensionContext context, Throwable failure) {
        // JUnit's own, not that of a future.
        if (failure instanceof TimeoutException
                && String.valueOf(failure.getMessage()).contains(" timed out after ")) {
            TIMEOUTS.put(context.getUniqueId(), failure);
        }
        return failure;
    }

    private static void refuse(ExtensionContext context) {
        Throwable timeout = TIMEOUTS.get(context.getUniqueId());
        if (timeout != null) {
            throw new IllegalStateException("Not run again: " + timeout.getMessage(), timeout);
        }
    }
}
