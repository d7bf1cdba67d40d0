package io.furrow.connect.source.notification;

import java.util.concurrent.atomic.AtomicBoolean;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Logs once that notifications arrive without {@code dateModified}. Thread-safe. */
final class UndatedWarning {
    private static final Logger LOG = LoggerFactory.getLogger(UndatedWarning.class);

    private final AtomicBoolean warned = new AtomicBoolean();

    /** @param source of the first notification without it, {@code /ngsi/<subscription>} */
    void note(String source) {
        if (!warned.get() && warned.compareAndSet(false, true)) {
            LOG.warn(
                    "Notifications of {} carry no dateModified: a change back to an earlier value under the same time"
                            + " of the device has the id of the earlier event, and readers drop it as a duplicate. Add"
                            + " dateModified to the notification's attrs, as in [\"*\", \"dateModified\"]",
                    source);
        }
    }
}
