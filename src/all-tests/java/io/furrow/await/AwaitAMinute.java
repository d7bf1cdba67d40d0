package io.furrow.await;

import java.time.Duration;

import org.awaitility.Awaitility;
import org.junit.jupiter.api.extension.BeforeAllCallback;
import org.junit.jupiter.api.extension.ExtensionContext;

/**
 * Gives every {@code await()} of every test a minute instead of Awaitility's ten seconds. A test goes on as soon as it can, so the minute
 * costs nothing; ten seconds are too few on a machine that has other work.
 */
public final class AwaitAMinute implements BeforeAllCallback {
    /** Made by JUnit. */
    public AwaitAMinute() {}

    @Override
    public void beforeAll(ExtensionContext context) {
        Awaitility.setDefaultTimeout(Duration.ofMinutes(1));
    }
}
