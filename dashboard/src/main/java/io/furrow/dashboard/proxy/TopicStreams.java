package io.furrow.dashboard.proxy;

import java.time.Duration;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.TimeUnit;

import org.apache.kafka.common.KafkaException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.dashboard.auth.UserCache;
import io.furrow.dashboard.feed.InitialState;
import io.furrow.dashboard.feed.InitialStateReader;
import io.furrow.dashboard.feed.StateBudget;
import io.furrow.dashboard.feed.StreamCounters;
import io.furrow.dashboard.feed.StreamLimits;
import io.furrow.dashboard.feed.TopicFeeds;
import io.furrow.dashboard.http.Problem;
import io.furrow.kafka.DaemonThreads;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.TopicRules;

/** Manages all streams, over sockets and as events: begins and ends them, pings them, and checks their users. */
public final class TopicStreams implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(TopicStreams.class);
    private static final long PING_SECONDS = 15;
    private static final long USER_SECONDS = 30;
    private static final long DISCONNECT_SECONDS = 3;
    /**
     * Age at which streams of proxy users are closed, so that they sign in again: the proxy does not report that a user
     * signed out.
     */
    private static final Duration MAX_AGE_BEHIND_PROXY = Duration.ofHours(1);

    private static final int START_THREADS = 16;
    private static final String STOPPING = "the dashboard is stopping";
    private static final int UNAUTHORIZED = 401;

    private final TopicFeeds feeds;
    private final InitialStateReader initialStates;
    private final TopicWriter writer;
    private final UserCache users;
    private final StreamQuota quota;
    private final Tickets tickets;
    private final TopicRules rules;
    private final StreamLimits limits;
    private final Set<OpenStream> streams = ConcurrentHashMap.newKeySet();
    private final StreamCounters counters = new StreamCounters();
    /** Has two threads, so that pings continue while one waits for the control plane. */
    private final ScheduledExecutorService scheduler =
            Executors.newScheduledThreadPool(2, DaemonThreads.named("streams-clock"));

    private final ExecutorService starter =
            Executors.newFixedThreadPool(START_THREADS, DaemonThreads.named("streams-begin"));
    private final ExecutorService remover = Executors.newSingleThreadExecutor(DaemonThreads.named("streams-end"));

    public TopicStreams(Properties client, TopicRules rules, StreamLimits limits, UserCache users) {
        this.feeds = new TopicFeeds(client, limits, counters);
        this.initialStates = new InitialStateReader(
                new InitialState(client, limits, StateBudget.ofHeap(), feeds::isCompacted)::read);
        this.writer = new TopicWriter(client, rules);
        this.users = users;
        this.rules = rules;
        this.limits = limits;
        this.quota = new StreamQuota(limits);
        this.tickets = new Tickets(limits, System::nanoTime);
        scheduler.scheduleWithFixedDelay(
                () -> streams.forEach(OpenStream::ping), PING_SECONDS, PING_SECONDS, TimeUnit.SECONDS);
        scheduler.scheduleWithFixedDelay(this::reauthenticate, USER_SECONDS, USER_SECONDS, TimeUnit.SECONDS);
    }

    Tickets tickets() {
        return tickets;
    }

    public TopicFeeds feeds() {
        return feeds;
    }

    TopicWriter writer() {
        return writer;
    }

    public StreamCounters counters() {
        return counters;
    }

    /** The number of unused tickets. */
    public int unusedTickets() {
        return tickets.unused();
    }

    /** The number of open sockets. */
    public int sockets() {
        return (int) streams.stream().filter(TopicSocket.class::isInstance).count();
    }

    public UserCache users() {
        return users;
    }

    TopicRules rules() {
        return rules;
    }

    StreamLimits limits() {
        return limits;
    }

    /** The number of open streams. */
    public int open() {
        return quota.open();
    }

    /**
     * Opens the socket of a ticket.
     *
     * @throws Problem if the ticket is unknown or used, or there are too many streams
     */
    public TopicSocket open(String ticketId) {
        Tickets.Ticket ticket = tickets.use(ticketId)
                .orElseThrow(() -> new Problem(
                        403,
                        "no-ticket",
                        "the path was used or has expired; GET /api/register/<topic> returns a new one"));
        quota.acquire(ticket.client());
        TopicSocket socket = new TopicSocket(this, ticket, limits);
        counters.add(StreamCounters.Count.STREAMS_OPENED, 1);
        streams.add(socket);
        return socket;
    }

    /** Counts a stream that is not a socket. @throws Problem if there are too many */
    void acquire(String client) {
        quota.acquire(client);
    }

    /**
     * Adds the stream to its topic, then reads the initial state, so that there is no gap between them.
     *
     * @return completes once each record that is written from then on goes to the stream; never if the stream ends
     *     before
     */
    CompletableFuture<Void> begin(StreamRequest request, OpenStream stream, SendQueue queue) {
        CompletableFuture<Void> begun = new CompletableFuture<>();
        if (streams.add(stream) && !(stream instanceof TopicSocket)) {
            counters.add(StreamCounters.Count.STREAMS_OPENED, 1);
        }
        if (stream.isClosed()) {
            streams.remove(stream);
        }
        try {
            starter.execute(() -> {
                try {
                    feeds.add(request.topic(), stream);
                    if (stream.isClosed()) { // closed meanwhile
                        feeds.remove(request.topic(), stream);
                        return;
                    }
                    begun.complete(null);
                    if (request.prime()) {
                        initialStates
                                .read(request.topic())
                                .whenComplete((state, failure) -> prime(request, stream, queue, state, failure));
                    }
                } catch (Problem | KafkaException e) {
                    fail(request, stream, e);
                } catch (RejectedExecutionException e) {
                    stream.end(STOPPING);
                } catch (InterruptedException e) {
                    Thread.currentThread().interrupt();
                }
            });
        } catch (RejectedExecutionException e) {
            stream.end(STOPPING);
        }
        return begun;
    }

    private static void prime(
            StreamRequest request, OpenStream stream, SendQueue queue, InitialState.State state, Throwable failure) {
        if (failure != null) {
            fail(request, stream, failure);
            return;
        }
        queue.prime(state);
        stream.flush();
    }

    private static void fail(StreamRequest request, OpenStream stream, Throwable failure) {
        if (failure instanceof Problem) {
            stream.end(failure.getMessage());
            return;
        }
        LOG.warn("topic {} cannot be read", request.topic(), failure);
        stream.end("topic '%s' cannot be read (%s)".formatted(request.topic(), FailureText.of(failure)));
    }

    void end(String topic, OpenStream stream, StreamCounters.Closing reason) {
        streams.remove(stream);
        counters.add(reason, 1);
        quota.release(stream.credentials().client());
        try {
            remover.execute(() -> feeds.remove(topic, stream));
        } catch (RejectedExecutionException e) {
            LOG.debug("closed already", e);
        }
    }

    void disconnectLater(Runnable task) {
        try {
            scheduler.schedule(task, DISCONNECT_SECONDS, TimeUnit.SECONDS);
        } catch (RejectedExecutionException e) {
            LOG.debug("closed already", e);
        }
    }

    /** Closes the streams of revoked tokens, and applies changed roles to open sockets. */
    private void reauthenticate() {
        for (OpenStream stream : streams) {
            try {
                stream.refresh(users.find(stream.credentials()));
                if (stream.credentials().isOfProxy()
                        && System.nanoTime() - stream.openedAt() > MAX_AGE_BEHIND_PROXY.toNanos()) {
                    stream.revoke("the proxy must authenticate the user again; register once more");
                }
            } catch (Problem e) {
                if (e.status() == UNAUTHORIZED || e.error().equals(UserCache.USERS_NOT_ACCEPTED)) {
                    stream.revoke("the token is no longer valid");
                }
            }
        }
    }

    @Override
    public void close() {
        for (OpenStream stream : streams) {
            if (stream instanceof TopicSocket socket) {
                socket.end(TopicSocket.GOING_AWAY, STOPPING, StreamCounters.Closing.STOPPING);
            } else {
                stream.end(STOPPING);
            }
        }
        scheduler.shutdownNow();
        starter.shutdownNow();
        remover.shutdownNow();
        initialStates.close();
        DaemonThreads.await(starter, Duration.ofSeconds(2));
        feeds.close();
        writer.close();
    }
}
