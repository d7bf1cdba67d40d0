package io.furrow.kafka;

import java.time.Clock;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.function.Supplier;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;

/**
 * The status of this control plane's parts, and of its dependencies. It is <b>alive</b> unless a part has ended that only a restart
 * of the process recovers; it is <b>ready</b> when all of its parts work. Other servers that it uses, such as a context broker, are
 * shown, but affect neither: another instance would not reach them either.
 */
public final class Readiness {
    private final Clock clock;
    private final List<Part> parts = new CopyOnWriteArrayList<>();

    private final List<Supplier<List<String>>> warnings = new CopyOnWriteArrayList<>();

    private record Part(Supplier<List<ComponentStatus>> statuses, boolean required) {}

    public Readiness(Clock clock) {
        this.clock = clock;
    }

    /** Adds a part that readiness requires. */
    public void require(Supplier<ComponentStatus> status) {
        requireAll(() -> List.of(status.get()));
    }

    /** Adds several of them. */
    public void requireAll(Supplier<List<ComponentStatus>> statuses) {
        parts.add(new Part(statuses, true));
    }

    /** Adds a server that is only shown. */
    public void show(Supplier<ComponentStatus> status) {
        parts.add(new Part(() -> List.of(status.get()), false));
    }

    /** Adds several of them. */
    public void showAll(Supplier<List<ComponentStatus>> statuses) {
        parts.add(new Part(statuses, false));
    }

    /** All parts, for metrics. */
    public List<ComponentStatus> statuses() {
        return all(false).toList();
    }

    /**
     * Adds sentences about conditions that require action although everything works; they are public, so they contain nothing about
     * the farm.
     */
    public void warn(Supplier<List<String>> sentences) {
        warnings.add(sentences);
    }

    public boolean isAlive() {
        return all(false).noneMatch(part -> part.state() == ComponentStatus.State.DEAD);
    }

    public boolean isReady() {
        return all(true).allMatch(part -> part.state() == ComponentStatus.State.UP);
    }

    private Stream<ComponentStatus> all(boolean requiredOnly) {
        return parts.stream()
                .filter(part -> part.required() || !requiredOnly)
                .flatMap(part -> part.statuses().get().stream());
    }

    /** {@code status}: up or dead. */
    public ObjectNode health() {
        return page(isAlive() ? "up" : "dead");
    }

    /** {@code status}: ready, degraded if an unavailable server is not needed by all requests, or not-ready. */
    public ObjectNode readiness() {
        boolean allUp = all(false).allMatch(part -> part.state() == ComponentStatus.State.UP);
        return page(allUp ? "ready" : isReady() ? "degraded" : "not-ready");
    }

    private ObjectNode page(String status) {
        ObjectNode page = NgsiJson.object().put("status", status);
        ObjectNode described = page.putObject("parts");
        all(false).forEach(part -> described.set(part.name(), described(part)));
        List<String> sentences =
                warnings.stream().flatMap(each -> each.get().stream()).toList();
        if (!sentences.isEmpty()) {
            sentences.forEach(page.putArray("warnings")::add);
        }
        return page;
    }

    private ObjectNode described(ComponentStatus part) {
        ObjectNode json = NgsiJson.object().put("state", part.state().code());
        if (part.lastSuccess() != null) {
            json.put("lastSuccess", part.lastSuccess().toString());
            Duration age = Duration.between(part.lastSuccess(), clock.instant());
            json.put("ageSeconds", Math.max(0, age.toMillis()) / 1000.0);
        }
        return part.detail().isEmpty() ? json : json.put("detail", part.detail());
    }
}
