package io.furrow.launcher.status;

import java.io.PrintWriter;
import java.net.URI;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Comparator;
import java.util.Deque;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.TreeMap;
import java.util.concurrent.ExecutionException;
import java.util.function.Supplier;

import org.apache.kafka.clients.admin.Admin;

import io.furrow.launcher.status.JobLag.Lag;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.result.CollisionResult;
import io.furrow.model.result.FieldResult;
import io.furrow.model.text.FailureText;

/**
 * The live status: the newest average of each field and scope, collisions as they happen, each job's lag, rate and total of each active topic. On a
 * terminal it is redrawn in place, elsewhere results are printed as lines and the rest every ten seconds.
 */
public final class Status implements AutoCloseable {
    private static final int COLLISIONS_SHOWN = 12;
    private static final int SECONDS_BETWEEN_BLOCKS = 10;

    /**
     * The content of the status.
     *
     * @param client settings of Kafka clients
     * @param jobs ids by name
     * @param notices a sentence for each condition that requires action
     * @param addresses of all parts, a line each
     */
    public record Shown(
            Admin admin,
            Properties client,
            URI flink,
            Map<String, String> jobs,
            Supplier<Collection<String>> notices,
            List<String> addresses) {}

    private final PrintWriter out;
    private final StatusScreen screen;
    private final List<String> addresses;
    private final TopicTotals totals;
    private final Rates rates = new Rates();
    private final JobLag lag;
    private final Results results;
    private final Supplier<Collection<String>> notices;
    private final Averages averages = new Averages();
    private final Deque<String> collisions = new ArrayDeque<>();
    private long ticks;

    /**
     * @param screen null if the output is not a terminal that can be redrawn
     * @param suite the content
     */
    public Status(PrintWriter out, StatusScreen screen, Shown suite) {
        this.out = out;
        this.screen = screen;
        this.addresses = suite.addresses();
        this.totals = new TopicTotals(suite.admin());
        this.lag = new JobLag(suite.flink(), suite.jobs());
        this.results = new Results(suite.client(), this::report);
        this.notices = suite.notices();
    }

    public void start() {
        results.start();
    }

    /** Reads and shows once; must be called every second. An unavailable Kafka is shown, not fatal. */
    public void tick() throws InterruptedException {
        boolean due = screen != null || ticks++ % SECONDS_BETWEEN_BLOCKS == 0;
        if (!due) {
            return;
        }
        try {
            TreeMap<String, Long> now = totals.read();
            show(block(now, rates.next(now, System.nanoTime()), lag.read(), ""));
        } catch (ExecutionException e) {
            show(block(
                    Map.of(), Map.of(), Map.of(), "Kafka does not tell its totals: " + FailureText.of(e.getCause())));
        }
    }

    @Override
    public void close() {
        results.close();
    }

    private synchronized void report(Entity entity, FiwareScope scope) {
        boolean average = entity.type().equals(FieldResult.TEMPERATURE_TYPE);
        String line = average ? averages.put(entity, scope) : ResultLines.collision(entity);
        if (!average) {
            if (CollisionResult.ONGOING.equals(
                    entity.text(CollisionResult.PHASE).orElse(""))) {
                return;
            }
            collisions.addFirst(line);
            while (collisions.size() > COLLISIONS_SHOWN) {
                collisions.removeLast();
            }
        }
        if (screen == null) {
            out.println((average ? "average   " : "collision ") + line);
            out.flush();
        }
    }

    private synchronized StatusBlock block(
            Map<String, Long> totals, Map<String, Double> perSecond, Map<String, Optional<Lag>> lags, String failure) {
        List<String> moving = totals.keySet().stream()
                .filter(topic -> perSecond.get(topic) > 0)
                .sorted(Comparator.comparing(perSecond::get).reversed())
                .map(topic ->
                        String.format(Locale.ROOT, "%-50s %10.1f %12d", topic, perSecond.get(topic), totals.get(topic)))
                .toList();
        List<String> jobs = lags.entrySet().stream()
                .map(job -> line(job.getKey(), job.getValue()))
                .toList();
        List<String> waiting = new ArrayList<>(notices.get());
        if (!failure.isEmpty()) {
            waiting.add(failure);
        }
        boolean inPlace = screen != null;
        return new StatusBlock(
                inPlace ? averages.lines() : List.of(),
                inPlace ? List.copyOf(collisions) : List.of(),
                waiting,
                jobs,
                moving,
                totals.size() - moving.size(),
                inPlace ? addresses : List.of());
    }

    private static String line(String job, Optional<Lag> lag) {
        return lag.map(worst -> "%-50s %10d %s"
                        .formatted(
                                job,
                                worst.records(),
                                worst.records() == 0 || worst.source().isEmpty() ? "" : "  of " + worst.source())
                        .stripTrailing())
                .orElse("%-50s %10s".formatted(job, "unknown")); // has read nothing yet
    }

    private void show(StatusBlock block) {
        if (screen != null) {
            screen.show(block::lines);
        } else {
            block.lines().forEach(out::println);
            out.flush();
        }
    }
}
