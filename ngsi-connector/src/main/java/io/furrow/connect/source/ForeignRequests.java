package io.furrow.connect.source;

import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.function.Function;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.LogText;
import io.furrow.connect.ledger.Ledger;
import io.furrow.http.Decision;

/**
 * Answers requests that name another host or come from a foreign page, and counts them. Logs each reason once, because a context
 * broker takes the answer for success and tells nobody.
 */
final class ForeignRequests implements Function<Decision.Refused, byte[]> {
    private static final Logger LOG = LoggerFactory.getLogger(ForeignRequests.class);
    /** Anybody can make up further ones. */
    private static final int MAX_LOGGED = 16;

    private final Set<String> logged = ConcurrentHashMap.newKeySet();
    private final Ledger ledger;

    ForeignRequests(Ledger ledger) {
        this.ledger = ledger;
    }

    @Override
    public byte[] apply(Decision.Refused refused) {
        ledger.foreign.increment();
        if (logged.size() < MAX_LOGGED && logged.add(refused.reason())) {
            LOG.warn("refused a request, and will refuse others like it: {}", LogText.oneLine(refused.reason()));
        }
        return Answer.error(refused.error(), refused.reason());
    }
}
