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

/** Permissions to open one socket, each used once: a browser cannot send a token with a socket, and a path shows in logs. */
final class Tickets {
    private static final int BYTES = 24;

    private final SecureRandom random = new SecureRandom();
    private final Map<String, Ticket> open = new LinkedHashMap<>();
    private final Map<String, Integer> ofClients = new LinkedHashMap<>();
    private final StreamLimits limits;
    private final LongSupplier nanos;

    /**
     * @param credentials of the user, to ask again whether they are still good
     */
    record Ticket(StreamRequest request, User user, Credentials credentials, long issued) {
        String client() {
            return credentials.client();
        }
    }

    Tickets(StreamLimits limits, LongSupplier nanos) {
        this.limits = limits;
        this.nanos = nanos;
    }

    /** @throws Problem 429 for a client that has too many unused */
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
        open.put(id, new Ticket(request, user, credentials, nanos.getAsLong()));
        ofClients.merge(client, 1, Integer::sum);
        return id;
    }

    /** Empty for one that is unknown, used or too old. */
    synchronized Optional<Ticket> use(String id) {
        expire();
        Ticket ticket = open.remove(id);
        if (ticket != null) {
            less(ticket.client());
        }
        return Optional.ofNullable(ticket);
    }

    /** How many are not used yet. */
    synchronized int unused() {
        expire();
        return open.size();
    }

    /** The oldest come first. */
    private void expire() {
        long now = nanos.getAsLong();
        open.values().removeIf(ticket -> {
            boolean old = now - ticket.issued() > limits.ticketLife().toNanos();
            if (old) {
                less(ticket.client());
            }
            return old;
        });
    }

    private void less(String client) {
        ofClients.computeIfPresent(client, (name, count) -> count == 1 ? null : count - 1);
    }
}
