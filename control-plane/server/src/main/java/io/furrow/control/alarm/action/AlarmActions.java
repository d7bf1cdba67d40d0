package io.furrow.control.alarm.action;

import java.io.IOException;
import java.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;
import java.util.concurrent.ArrayBlockingQueue;
import java.util.concurrent.ThreadPoolExecutor;
import java.util.concurrent.TimeUnit;

import io.furrow.control.alarm.watch.DeviceTypeCache;
import io.furrow.control.audit.AuditEntry;
import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.DaemonThreads;
import io.furrow.kafka.SupervisedWorker;
import io.furrow.model.text.Counts;

/**
 * Delivers alarms to a webhook and stops robots that are predicted to meet. The two actions share no thread, so that
 * neither delays the other. Several instances share the work.
 */
public final class AlarmActions implements AutoCloseable {
    private static final int STOP_THREADS = 8;
    private static final int MAX_STOPS_WAITING = 1000;
    private static final Duration CLOSE_TIMEOUT = Duration.ofSeconds(5);

    private final List<SupervisedWorker> workers = new ArrayList<>();
    private ThreadPoolExecutor stops;
    private AuditLog audit;

    private AlarmActions() {}

    /**
     * @param client settings of Kafka clients
     * @param webhook null to deliver nothing
     * @param stop null to stop nothing
     * @throws IOException if the webhook's secret cannot be used; the message says what to do
     */
    public static AlarmActions start(Properties client, Webhook.Settings webhook, StopRobots.Settings stop)
            throws IOException {
        AlarmActions actions = new AlarmActions();
        Clock clock = Clock.systemUTC();
        if (webhook != null) {
            AlarmDelivery delivery = new AlarmDelivery(client, webhook, new Webhook(webhook, clock), clock);
            actions.workers.add(new SupervisedWorker(AlarmDelivery.NAME, clock).start(delivery, delivery::detail));
        }
        if (stop != null) {
            actions.stopRobots(client, stop, clock);
        }
        return actions;
    }

    private void stopRobots(Properties client, StopRobots.Settings settings, Clock clock) {
        audit = new AuditLog(client);
        stops = new ThreadPoolExecutor(
                STOP_THREADS,
                STOP_THREADS,
                1,
                TimeUnit.MINUTES,
                new ArrayBlockingQueue<>(MAX_STOPS_WAITING),
                task -> new Thread(task, "furrow-stop"));
        SupervisedWorker worker = new SupervisedWorker(PredictionConsumer.NAME, clock);
        DeviceTypeCache types = new DeviceTypeCache(client);
        StopRobots robots = new StopRobots(settings, types, entry -> note(entry, worker), stops, clock);
        workers.add(new SupervisedWorker(DeviceTypeCache.NAME, clock).start(types, types::detail));
        workers.add(worker.start(new PredictionConsumer(client, robots, types, clock), () -> stopsWaiting(types)));
    }

    private void note(AuditEntry entry, SupervisedWorker worker) {
        if (entry.reason() == null) {
            worker.succeeded();
        } else {
            worker.failed(entry.about() + " " + entry.reason());
        }
        audit.accept(entry);
    }

    private String stopsWaiting(DeviceTypeCache types) {
        if (!types.isLoaded()) {
            return "waits until the types of devices are read";
        }
        return "%s being stopped, %d waiting"
                .formatted(
                        Counts.are(stops.getActiveCount(), "robot"),
                        stops.getQueue().size());
    }

    /** Returns the status of each worker thread, for a health page. */
    public List<ComponentStatus> workers() {
        return workers.stream().map(SupervisedWorker::status).toList();
    }

    @Override
    public void close() {
        workers.forEach(SupervisedWorker::close);
        if (stops != null) {
            stops.shutdown();
            DaemonThreads.await(stops, CLOSE_TIMEOUT);
            audit.close();
        }
    }
}
