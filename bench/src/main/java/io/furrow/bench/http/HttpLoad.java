package io.furrow.bench.http;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.InetSocketAddress;
import java.nio.channels.SelectionKey;
import java.nio.channels.Selector;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.Deque;
import java.util.List;
import java.util.concurrent.TimeUnit;

import org.HdrHistogram.Histogram;

/**
 * Sends notifications from one thread. With a rate, a request is due at its time independently of earlier ones, and its delay
 * counts from then: if a server stops for a second, all requests of that second show the delay.
 */
public final class HttpLoad {
    private static final long MAX_MICROS = TimeUnit.MINUTES.toMicros(5);
    private static final int DIGITS = 3;
    private static final long LAST_ANSWERS_NANOS = TimeUnit.SECONDS.toNanos(15);
    private static final long SECOND = TimeUnit.SECONDS.toNanos(1);

    private final InetSocketAddress target;
    private final Plan plan;
    private final long firstNumber;
    private final Histogram latency = new Histogram(MAX_MICROS, DIGITS);
    private final BitSet acknowledged = new BitSet();
    private final Deque<Exchange> idle = new ArrayDeque<>();
    private final List<Exchange> failed = new ArrayList<>();
    private long startNanos;
    private long lastAnswerNanos;
    private long refused;
    private long broken;
    private volatile long sent;
    private volatile long answered;

    /** @param firstNumber of the notifications, which are numbered consecutively */
    public HttpLoad(InetSocketAddress target, Plan plan, long firstNumber) {
        this.target = target;
        this.plan = plan;
        this.firstNumber = firstNumber;
    }

    /** Requests sent so far; thread-safe. */
    public long sent() {
        return sent;
    }

    /** Answers 2xx so far; thread-safe. */
    public long answered() {
        return answered;
    }

    /**
     * Sends the requests due in the time of the plan and waits for the answers; requests that could not be sent then count as
     * broken. May be called once.
     */
    public Result run() {
        try (Selector selector = Selector.open()) {
            List<Exchange> all = new ArrayList<>();
            for (int i = 0; i < plan.connections(); i++) {
                NotificationRequest request = NotificationRequest.to(target, plan.payloadBytes(), plan.entities());
                all.add(new Exchange(target, selector, request, !plan.newConnections()));
            }
            idle.addAll(all);
            startNanos = System.nanoTime();
            lastAnswerNanos = startNanos;
            long end = startNanos + plan.duration().toNanos();
            for (long now = startNanos; now < end; now = System.nanoTime()) {
                sendDue(now);
                await(selector, now, end);
            }
            long last = end + LAST_ANSWERS_NANOS;
            for (long now = end; (isOwing() || openExchanges(all) > 0) && now < last; now = System.nanoTime()) {
                if (isOwing()) {
                    sendDue(now);
                }
                await(selector, now, last);
            }
            broken += openExchanges(all) + (isOwing() ? planned() - sent : 0);
            all.forEach(Exchange::close);
            long nanos = Math.max(1, lastAnswerNanos - startNanos);
            return new Result(firstNumber, acknowledged, refused, broken, latency, nanos);
        } catch (IOException e) {
            throw new UncheckedIOException("the load on " + target + " broke off", e);
        }
    }

    /** Whether requests due within the time of the plan are still to be sent. */
    private boolean isOwing() {
        return plan.rate() > 0 && sent < planned();
    }

    private long planned() {
        return plan.rate() == 0 ? Long.MAX_VALUE : plan.duration().toNanos() * plan.rate() / SECOND;
    }

    private int openExchanges(List<Exchange> all) {
        return all.size() - idle.size() - failed.size();
    }

    private void sendDue(long now) {
        long due = dueNanos(now);
        while (!idle.isEmpty() && due <= now && sent < planned()) {
            Exchange exchange = idle.poll();
            long number = firstNumber + sent;
            sent = sent + 1;
            try {
                exchange.send(number, due);
            } catch (IOException e) {
                fail(exchange);
            }
            due = dueNanos(now);
        }
        idle.addAll(failed); // deferred, or an unavailable server would never let this loop end
        failed.clear();
    }

    /** When the next request is due. */
    private long dueNanos(long now) {
        return plan.rate() == 0 ? now : startNanos + sent * SECOND / plan.rate();
    }

    private void await(Selector selector, long now, long end) throws IOException {
        long until = idle.isEmpty() ? end : Math.min(end, dueNanos(now));
        long millis = Math.max(1, TimeUnit.NANOSECONDS.toMillis(until - now));
        selector.select(this::proceed, millis);
    }

    private void proceed(SelectionKey key) {
        Exchange exchange = (Exchange) key.attachment();
        try {
            int status = exchange.proceed();
            if (status == 0) {
                return;
            }
            lastAnswerNanos = System.nanoTime();
            if (status / 100 == 2) {
                acknowledged.set((int) (exchange.number() - firstNumber));
                long micros = TimeUnit.NANOSECONDS.toMicros(lastAnswerNanos - exchange.dueNanos());
                latency.recordValue(Math.min(MAX_MICROS, Math.max(0, micros)));
                answered = answered + 1;
            } else {
                refused++;
            }
            idle.add(exchange);
        } catch (IOException e) {
            fail(exchange);
        }
    }

    /** The server may also close an idle connection: that is not a broken request. */
    private void fail(Exchange exchange) {
        exchange.close();
        if (idle.contains(exchange)) {
            return;
        }
        broken++;
        failed.add(exchange);
    }

    /**
     * A load of notifications.
     *
     * @param connections maximum number of open requests
     * @param newConnections whether each request uses a new connection, as Orion does by default
     * @param rate requests per second, independent of answers; 0 for as many as are answered
     * @param payloadBytes of a body
     * @param entities number of ids
     */
    public record Plan(
            int connections, boolean newConnections, int rate, int payloadBytes, int entities, Duration duration) {
        /** The same with another duration. */
        public Plan lasting(Duration other) {
            return new Plan(connections, newConnections, rate, payloadBytes, entities, other);
        }
    }

    /**
     * The result of a load.
     *
     * @param acknowledged the numbers, counted from {@code firstNumber}, of the notifications answered 2xx
     * @param refused requests with another answer
     * @param broken requests whose connection failed before the answer
     * @param latency microseconds from when a request was due to its answer, of those answered 2xx
     * @param nanos from the first request to the last answer
     */
    public record Result(
            long firstNumber, BitSet acknowledged, long refused, long broken, Histogram latency, long nanos) {
        /** Number of notifications answered 2xx. */
        public long answered() {
            return latency.getTotalCount();
        }

        public double perSecond() {
            return answered() * 1e9 / nanos;
        }

        public double millis(double percentile) {
            return latency.getValueAtPercentile(percentile) / 1000.0;
        }
    }
}
