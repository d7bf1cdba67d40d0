package io.furrow.fiware.broker;

import java.time.Clock;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicLong;
import java.util.concurrent.atomic.LongAdder;

import org.eclipse.jetty.client.BytesRequestContent;
import org.eclipse.jetty.client.ConnectionPool;
import org.eclipse.jetty.client.Destination;
import org.eclipse.jetty.client.DuplexConnectionPool;
import org.eclipse.jetty.client.HttpClient;
import org.eclipse.jetty.client.Request;
import org.eclipse.jetty.client.Result;
import org.eclipse.jetty.http.HttpField;
import org.eclipse.jetty.http.HttpFields;
import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.http.HttpMethod;
import org.eclipse.jetty.util.component.LifeCycle;
import org.eclipse.jetty.util.thread.QueuedThreadPool;

import io.furrow.fiware.http.Correlator;
import io.furrow.model.text.FailureText;

/**
 * Sends each notification once, over persistent connections or a new one each. Any HTTP status is a success; a refused
 * connection or a timeout is a failure. Up to {@value #QUEUES} are in flight for one subscription, one for one entity.
 * What exceeds {@value #MAX_QUEUED} notifications or {@value #MAX_QUEUED_BYTES} bytes of a subscription's queue is
 * dropped and counted.
 */
public final class Notifier implements AutoCloseable {
    static final int MAX_QUEUED = 20_000;
    static final long MAX_QUEUED_BYTES = 128L << 20;
    private static final int QUEUES = 16;
    private static final int CONNECTIONS_PER_RECEIVER = 64;
    private static final int THREADS = 8;
    private static final long CONNECT_TIMEOUT_MS = 5_000;
    /** Shorter than the idle timeouts of receivers, so that they never close a connection during a request. */
    private static final long IDLE_TIMEOUT_MS = 20_000;

    private final Clock clock;
    private final HttpClient client = new HttpClient();
    private final QueuedThreadPool threads = new QueuedThreadPool(THREADS, 2);
    private final Map<String, ReceiverQueue> outboxes = new ConcurrentHashMap<>();
    private volatile boolean closed;
    private final LongAdder sent = new LongAdder();
    private final LongAdder failed = new LongAdder();
    private final LongAdder dropped = new LongAdder();

    /** @param persistent whether a connection is used for several notifications */
    public Notifier(Clock clock, boolean persistent) {
        this.clock = clock;
        threads.setName("furrow-notifier");
        threads.setDaemon(true);
        client.setExecutor(threads);
        client.setConnectTimeout(CONNECT_TIMEOUT_MS);
        client.setIdleTimeout(IDLE_TIMEOUT_MS);
        client.setMaxConnectionsPerDestination(CONNECTIONS_PER_RECEIVER);
        client.setFollowRedirects(false);
        if (!persistent) {
            client.getTransport().setConnectionPoolFactory(Notifier::usedOnce);
        }
        client.setUserAgentField(new HttpField(HttpHeader.USER_AGENT, "furrow-fiware-stand-in/0.1"));
    }

    private static ConnectionPool usedOnce(Destination receiver) {
        DuplexConnectionPool pool = new DuplexConnectionPool(receiver, CONNECTIONS_PER_RECEIVER);
        pool.setMaxUsage(1);
        return pool;
    }

    public void start() {
        LifeCycle.start(client);
        client.getContentDecoderFactories().clear();
    }

    /** Queues the notification; returns at once. */
    void offer(OutgoingNotification notification) {
        outboxes.computeIfAbsent(notification.subscription().id(), id -> new ReceiverQueue())
                .offer(notification);
    }

    /** Removes the queue of a subscription; queued notifications are still sent. */
    public void forget(String subscriptionId) {
        outboxes.remove(subscriptionId);
    }

    public long sent() {
        return sent.sum();
    }

    public long failed() {
        return failed.sum();
    }

    public long dropped() {
        return dropped.sum();
    }

    public long queued() {
        return outboxes.values().stream().mapToLong(queue -> queue.count.get()).sum();
    }

    @Override
    public void close() {
        closed = true;
        LifeCycle.stop(client);
        LifeCycle.stop(threads);
    }

    private Request request(OutgoingNotification notification) {
        SubscriptionDefinition definition = notification.subscription().definition();
        SubscriptionDefinition.Target target = definition.target();
        return client.newRequest(target.url())
                .method(HttpMethod.POST)
                .timeout(target.timeout().toMillis(), TimeUnit.MILLISECONDS)
                .headers(headers -> headers(headers, notification, definition))
                .body(new BytesRequestContent("application/json; charset=utf-8", notification.body()));
    }

    private static void headers(
            HttpFields.Mutable headers, OutgoingNotification from, SubscriptionDefinition definition) {
        var scope = from.change().after().scope();
        if (!scope.service().isEmpty()) {
            headers.put("Fiware-Service", scope.service());
        }
        headers.put("Fiware-Servicepath", scope.servicePath());
        headers.put(HttpHeader.ACCEPT, "application/json");
        headers.put(HttpHeader.CONTENT_TYPE, "application/json; charset=utf-8");
        definition.target().headers().forEach((name, value) -> {
            if (value.isEmpty()) {
                headers.remove(name);
            } else {
                headers.put(name, value);
            }
        });
        headers.put(Correlator.HEADER, from.correlator());
        headers.put("Ngsiv2-AttrsFormat", definition.rendering().format().label());
    }

    private void record(Subscription subscription, Result result) {
        boolean answered = result.getResponse().getStatus() > 0 && result.getResponseFailure() == null;
        if (answered) {
            sent.increment();
            subscription.succeeded(clock.instant(), result.getResponse().getStatus());
        } else {
            failed.increment();
            Throwable failure = result.getFailure();
            subscription.failed(clock.instant(), FailureText.of(failure));
        }
    }

    /** The queued notifications of one subscription. */
    private final class ReceiverQueue {
        private final NotificationQueue[] queues = new NotificationQueue[QUEUES];
        private final AtomicLong count = new AtomicLong();
        private final AtomicLong bytes = new AtomicLong();

        private ReceiverQueue() {
            for (int i = 0; i < QUEUES; i++) {
                queues[i] = new NotificationQueue(threads, this::send);
            }
        }

        private void offer(OutgoingNotification notification) {
            StoredEntity entity = notification.change().after();
            if (count.get() >= MAX_QUEUED || bytes.get() >= MAX_QUEUED_BYTES) {
                dropped.increment();
                return;
            }
            count.incrementAndGet();
            bytes.addAndGet(entity.weight());
            queues[Math.floorMod(entity.scope().identity(entity.id()).hashCode(), QUEUES)].offer(notification);
        }

        private void send(OutgoingNotification notification, Runnable done) {
            if (closed) {
                return;
            }
            request(notification).send(result -> {
                record(notification.subscription(), result);
                count.decrementAndGet();
                bytes.addAndGet(-notification.change().after().weight());
                done.run();
            });
        }
    }
}
