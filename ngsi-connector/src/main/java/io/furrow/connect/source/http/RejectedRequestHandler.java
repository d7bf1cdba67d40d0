package io.furrow.connect.source.http;

import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.function.Function;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.ledger.Ledger;
import io.furrow.http.Decision;
import io.furrow.model.text.LogText;

/**
 * Answers and counts requests that name another host or come from a page of another origin. Logs each reason once,
 * because a context broker treats the answer as success and reports nothing.
 */
public final class RejectedRequestHandler implements Function<Decision.Refused, byte[]> {
    private static final Logger LOG = LoggerFactory.getLogger(RejectedRequestHandler.class);
    /** A sender can invent any number of reasons. */
    private static final int MAX_LOGGED = 16;

    private final Set<String> logged = ConcurrentHashMap.newKeySet();
    private final Ledger ledger;

    public RejectedRequestHandler(Ledger ledger) {
        this.ledger = ledger;
    }

    @Override
    public byte[] apply(Decision.Refused refused) {
        ledger.foreign.increment();
        if (logged.size() < MAX_LOGGED && logged.add(refused.reason())) {
            LOG.warn("rejected a request, and will reject others like it: {}", LogText.oneLine(refused.reason()));
        }
        return NotificationResponse.error(refused.error(), refused.reason());
    }
}
