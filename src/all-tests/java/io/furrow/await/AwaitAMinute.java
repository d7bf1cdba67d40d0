package io.furrow.await;

import java.time.Duration;

import org.awaitility.Awaitility;
import org.junit.jupiter.api.extension.BeforeAllCallback;
import org.junit.jupiter.api.extension.ExtensionContext;

/** Sets the default timeout of Awaitility to a minute: its ten seconds are too short on a busy machine. */
public final class AwaitAMinute implements BeforeAllCallback {
    /** Called by JUnit. */
    public AwaitAMinute() {}

    @Override
    public void beforeAll(ExtensionContext context) {
        Awaitility.setDefaultTimeout(Duration.ofMinutes(1));
    }
}
