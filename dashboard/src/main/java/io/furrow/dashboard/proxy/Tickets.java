package io.furrow.dashboard.proxy;

import java.security.SecureRandom;
import java.util.Base64;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Optional;
import java.util.function.LongSupplier;

import io.furrow.dashboard.auth.Credentials;
import io.furrow.dashboard.auth.User;
import io.furrow.dashboard.feed.StreamLimits;
import io.furrow.dashboard.http.Problem;

/**
 * Issues tickets, each of which opens one socket once: a browser cannot send a token with a socket, and a path appears
 * in logs.
 */
final class Tickets {
    private static final int BYTES = 24;

    private final SecureRandom random = new SecureRandom();
    private final Map<String, Ticket> unused = new LinkedHashMap<>();
    private final Map<String, Integer> ofClients = new LinkedHashMap<>();
    private final StreamLimits limits;
    private final LongSupplier nanos;

    /** @param credentials of the user, to check them again while the socket is unused */
    record Ticket(StreamRequest request, User user, Credentials credentials, long issued) {
        String client() {
            return credentials.client();
        }
    }

    Tickets(StreamLimits limits, LongSupplier nanos) {
        this.limits = limits;
        this.nanos = nanos;
    }

    /** @throws Problem 429 if the client has too many unused tickets */
    synchronized String issue(StreamRequest request, User user, Credentials credentials) {
        expire();
        String client = credentials.client();
        if (ofClients.getOrDefault(client, 0) >= limits.tickets()) {
            throw new Problem(
                    429,
                    "too-many-tickets",
                    "%d sockets were registered and not opened; open them or wait %d s"
                            .formatted(limits.tickets(), limits.ticketLife().toSeconds()));
        }
        byte[] bytes = new byte[BYTES];
        random.nextBytes(bytes);
        String id = Base64.getUrlEncoder().withoutPadding().encodeToString(bytes);
        unused.put(id, new Ticket(request, user, credentials, nanos.getAsLong()));
        ofClients.merge(client, 1, Integer::sum);
        return id;
    }

    /** Empty for a ticket that is unknown, used or expired. */
    synchronized Optional<Ticket> use(String id) {
        expire();
        Ticket ticket = unused.remove(id);
        if (ticket != null) {
            decrement(ticket.client());
        }
        return Optional.ofNullable(ticket);
    }

    /** The number of unused tickets. */
    synchronized int unused() {
        expire();
        return unused.size();
    }

    /** Removes expired tickets. */
    private void expire() {
        long now = nanos.getAsLong();
        unused.values().removeIf(ticket -> {
            boolean expired = now - ticket.issued() > limits.ticketLife().toNanos();
            if (expired) {
                decrement(ticket.client());
            }
            return expired;
        });
    }

    private void decrement(String client) {
        ofClients.computeIfPresent(client, (name, count) -> count == 1 ? null : count - 1);
    }
}
