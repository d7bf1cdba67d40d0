package io.furrow.control.rest.view;

import java.time.Duration;
import java.util.ArrayDeque;
import java.util.Comparator;
import java.util.Deque;
import java.util.List;
import java.util.OptionalLong;
import java.util.concurrent.Semaphore;
import java.util.concurrent.TimeUnit;
import java.util.function.Predicate;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.control.replay.ReplaySettings;
import io.furrow.control.rest.access.ProblemException;
import io.furrow.mission.RecordingException;
import io.furrow.mission.ThinnedSeries;
import io.furrow.mission.mongo.AttributeHistory;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.TopicName;
import io.furrow.model.topic.Topics;

/**
 * Answers how an attribute of a device changed over time, from all missions that were recorded in the period. A request
 * reads for 15 s at most, the newest values first, so that what it omits is the oldest part of the period.
 */
public final class DeviceHistory implements AutoCloseable {
    /** Maximum number of changes of a text; the newest are retained. */
    private static final int MAX_CHANGES = 500;

    private static final int MAX_CONCURRENT = 4;
    private static final long WAIT_SECONDS = 5;
    private static final Duration LIMIT = Duration.ofSeconds(15);
    /** The list of recordings is up to half a minute old, and events may be late. */
    private static final long LIST_AGE_MS = 120_000;

    private final StateView view;
    private final AttributeHistory values;
    private final Duration limit;
    private final Semaphore free = new Semaphore(MAX_CONCURRENT);

    DeviceHistory(StateView view, AttributeHistory values, Duration limit) {
        this.view = view;
        this.values = values;
        this.limit = limit;
    }

    /** Opens the missions without waiting for MongoDB. @return null if the control plane has no MongoDB */
    public static DeviceHistory of(StateView view, ReplaySettings settings) {
        return settings.mongo() == null
                ? null
                : new DeviceHistory(view, AttributeHistory.open(settings.mongo(), settings.database()), LIMIT);
    }

    /**
     * A request.
     *
     * @param isOfType whether a type is that of the device
     * @param mission the only one to read; null for all
     * @param maxPoints at least {@value ThinnedSeries#MIN_POINTS}
     */
    public record Request(
            FiwareScope scope,
            Predicate<String> isOfType,
            AttributeHistory.Range range,
            String mission,
            int maxPoints) {}

    /** @param first its oldest event when it was listed, epoch ms; {@code last} likewise the newest one */
    private record Listed(String mission, long first, long last) {}

    /**
     * Returns the points of the request.
     *
     * @throws ProblemException if the mission is not recorded, too many requests are running, or MongoDB is unavailable
     */
    public ObjectNode read(Request request) {
        List<Listed> recorded = recorded(request);
        try {
            if (!free.tryAcquire(WAIT_SECONDS, TimeUnit.SECONDS)) {
                throw ProblemException.overloaded();
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw ProblemException.overloaded();
        }
        try {
            return new Reading(request).read(recorded);
        } catch (RecordingException e) {
            throw new ProblemException(503, "mongodb-away", e.getMessage());
        } finally {
            free.release();
        }
    }

    /** Returns the recordings with events in the period, the newest first. */
    private List<Listed> recorded(Request request) {
        String mission = request.mission();
        List<Listed> found = view.all(Topics.RECORDINGS)
                .map(each -> new Listed(
                        each.path("mission").asText(),
                        each.path("first").asLong(),
                        each.path("last").asLong()))
                .filter(each -> mission == null
                        || each.mission().equals(mission)
                        || each.mission().equals(TopicName.of(mission)))
                .toList();
        if (mission != null && found.isEmpty()) {
            throw EventTiles.unknown(mission);
        }
        return found.stream()
                .filter(each -> each.first() < request.range().to()
                        && each.last() + LIST_AGE_MS >= request.range().from())
                .sorted(Comparator.comparingLong(Listed::last).reversed())
                .toList();
    }

    /** @param time since when the attribute had the text, epoch ms */
    private record Change(long time, String text) {}

    /** Processes one request. */
    private final class Reading {
        private final Request request;
        private final AttributeHistory.Range range;
        private final ThinnedSeries series;
        /** Of the newest value; null before it. */
        private String unit;

        private boolean isBoolean = true;
        private long skipped;
        private long texts;
        /** The newest first. */
        private final Deque<Change> changes = new ArrayDeque<>();

        private boolean isCut;

        Reading(Request request) {
            this.request = request;
            this.range = request.range();
            this.series = new ThinnedSeries(range.from(), range.to(), request.maxPoints());
        }

        ObjectNode read(List<Listed> recorded) throws RecordingException {
            long deadline = System.nanoTime() + limit.toNanos();
            // nothing is stored of the time before the first event of all
            long since =
                    recorded.stream().mapToLong(Listed::first).reduce(Math::min).orElse(range.to());
            since = Math.max(range.from(), since);
            ArrayNode missions = NgsiJson.array();
            for (Listed each : recorded) {
                if (System.nanoTime() > deadline) {
                    since = Math.max(since, Math.min(range.to(), each.last() + LIST_AGE_MS));
                    continue;
                }
                OptionalLong complete = values.read(each.mission(), range, deadline, this::add);
                if (complete.isPresent()) {
                    since = Math.max(since, complete.getAsLong());
                    missions.add(each.mission());
                }
            }
            return json(isCut ? Math.max(since, changes.getLast().time()) : since, missions);
        }

        private void add(AttributeHistory.Value value) {
            if (!value.scope().equals(request.scope()) || !request.isOfType().test(value.type())) {
                return;
            }
            unit = unit == null ? value.unit() : unit;
            if (!value.text().isEmpty()) {
                addText(value);
            } else if (Double.isNaN(value.number()) || !value.unit().equals(unit)) {
                skipped++;
            } else {
                isBoolean &= value.isBoolean();
                series.add(value.time(), value.number());
            }
        }

        private void addText(AttributeHistory.Value value) {
            texts++;
            boolean isSame = !changes.isEmpty() && changes.getLast().text().equals(value.text());
            if (!isCut && isSame) {
                changes.removeLast();
            }
            isCut |= !isSame && changes.size() == MAX_CHANGES;
            if (!isCut) {
                changes.add(new Change(value.time(), value.text()));
            }
        }

        private boolean isText() {
            return series.count() == 0 && texts > 0;
        }

        private String kind() {
            String without = isText() ? "text" : skipped > 0 ? "other" : "none";
            return series.count() > 0 ? isBoolean ? "boolean" : "number" : without;
        }

        private ObjectNode json(long since, ArrayNode missions) {
            ObjectNode json = NgsiJson.object()
                    .put("device", range.entity())
                    .put("attribute", range.attribute())
                    .put("from", range.from())
                    .put("to", range.to())
                    .put("since", since)
                    .put("kind", kind())
                    .put("unit", unit == null ? "" : unit)
                    .put("values", isText() ? texts : series.count())
                    .put("skipped", isText() ? skipped : skipped + texts)
                    .put("width", series.partMillis());
            json.set("missions", missions);
            ArrayNode points = json.putArray("points");
            for (ThinnedSeries.Point each : series.points()) {
                points.addObject().put("time", each.time()).put("value", each.value());
            }
            if (isText()) {
                ArrayNode found = json.putArray("changes");
                changes.descendingIterator()
                        .forEachRemaining(each ->
                                found.addObject().put("time", each.time()).put("value", each.text()));
            }
            return json;
        }
    }

    @Override
    public void close() {
        values.close();
    }
}
