package io.furrow.control.rest;

import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.LongAdder;

import io.prometheus.metrics.expositionformats.PrometheusTextFormatWriter;
import io.prometheus.metrics.model.snapshots.CounterSnapshot;
import io.prometheus.metrics.model.snapshots.CounterSnapshot.CounterDataPointSnapshot;
import io.prometheus.metrics.model.snapshots.GaugeSnapshot;
import io.prometheus.metrics.model.snapshots.GaugeSnapshot.GaugeDataPointSnapshot;
import io.prometheus.metrics.model.snapshots.Labels;
import io.prometheus.metrics.model.snapshots.MetricSnapshots;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.container.ContainerResponseContext;
import jakarta.ws.rs.container.ContainerResponseFilter;
import jakarta.ws.rs.container.PreMatching;
import org.glassfish.jersey.server.ExtendedUriInfo;
import org.glassfish.jersey.uri.UriTemplate;

import io.furrow.control.readiness.Readiness;
import io.furrow.control.rest.view.PendingReplies;
import io.furrow.control.rest.view.StateView;
import io.furrow.kafka.ComponentStatus;
import io.furrow.model.topic.Topics;

/** Counts requests, and writes that and what the view holds in the text format of Prometheus. */
@PreMatching
final class RestMetrics implements ContainerRequestFilter, ContainerResponseFilter {
    static final String CONTENT_TYPE = PrometheusTextFormatWriter.CONTENT_TYPE;

    private static final Set<String> METHODS = Set.of("GET", "HEAD", "OPTIONS", "POST", "PATCH", "PUT", "DELETE");
    private static final String BEGUN = "furrow.begun";
    private static final String STATE = "state";

    private final StateView view;
    private final PendingReplies answers;
    private final Readiness readiness;
    private final Map<Route, Count> counts = new ConcurrentHashMap<>();
    private final PrometheusTextFormatWriter writer =
            PrometheusTextFormatWriter.builder().build();

    private record Route(String method, String path, int status) {}

    private record Count(LongAdder requests, LongAdder nanos) {}

    RestMetrics(StateView view, PendingReplies answers, Readiness readiness) {
        this.view = view;
        this.answers = answers;
        this.readiness = readiness;
    }

    @Override
    public void filter(ContainerRequestContext request) {
        request.setProperty(BEGUN, System.nanoTime());
    }

    @Override
    public void filter(ContainerRequestContext request, ContainerResponseContext response) {
        String method = METHODS.contains(request.getMethod()) ? request.getMethod() : "other";
        Route route = new Route(method, path(request), response.getStatus());
        Count count = counts.computeIfAbsent(route, any -> new Count(new LongAdder(), new LongAdder()));
        count.requests().increment();
        if (request.getProperty(BEGUN) instanceof Long begun) {
            count.nanos().add(System.nanoTime() - begun);
        }
    }

    /** As it is declared, so that names do not become labels. */
    private static String path(ContainerRequestContext request) {
        StringBuilder path = new StringBuilder();
        if (request.getUriInfo() instanceof ExtendedUriInfo matched) {
            for (UriTemplate template : matched.getMatchedTemplates()) {
                path.insert(0, template.getTemplate());
            }
        }
        return path.isEmpty() ? "none" : path.toString().replace("//", "/");
    }

    byte[] page() {
        CounterSnapshot.Builder requests = CounterSnapshot.builder()
                .name("furrow_control_requests")
                .help("Requests to the REST API that were answered.");
        CounterSnapshot.Builder seconds = CounterSnapshot.builder()
                .name("furrow_control_request_seconds")
                .help("Seconds between requests and their answers, added up.");
        counts.forEach((route, count) -> {
            Labels labels = Labels.of(
                    "method", route.method(), "path", route.path(), "status", Integer.toString(route.status()));
            requests.dataPoint(point(labels, count.requests().sum()));
            seconds.dataPoint(point(labels, count.nanos().sum() / 1e9));
        });
        CounterSnapshot.Builder answered = CounterSnapshot.builder()
                .name("furrow_control_answers")
                .help("Answers of the managers, to whomever, that were read since this instance was ready.");
        answers.counts()
                .forEach((kind, count) -> answered.dataPoint(
                        point(Labels.of("manager", kind.topic(), "status", kind.status()), count.sum())));
        GaugeSnapshot.Builder parts =
                gauge("part_up", "1 where a part of this instance, or something that it speaks with, works.");
        readiness
                .statuses()
                .forEach(part -> parts.dataPoint(
                        value(Labels.of("part", part.name()), part.state() == ComponentStatus.State.UP ? 1 : 0)));
        MetricSnapshots.Builder metrics = MetricSnapshots.builder()
                .metricSnapshot(parts.build())
                .metricSnapshot(answered.build())
                .metricSnapshot(requests.build())
                .metricSnapshot(seconds.build())
                .metricSnapshot(gauge("awaited", "Requests whose answer a manager owes.")
                        .dataPoint(value(Labels.EMPTY, answers.awaited()))
                        .build())
                .metricSnapshot(gauge("view_complete", "1 where the topics were read to their ends.")
                        .dataPoint(value(Labels.EMPTY, view.isComplete() ? 1 : 0))
                        .build());
        if (view.isComplete()) {
            metrics.metricSnapshot(byState("missions", "Missions by state.", Topics.MISSIONS_STATUS));
            metrics.metricSnapshot(byState("devices", "Devices by what their hosts say.", Topics.DEVICES_STATUS));
            metrics.metricSnapshot(byState("alarms", "Alarms by state.", Topics.ALARMS));
        }
        return write(metrics.build());
    }

    private GaugeSnapshot byState(String name, String help, String topic) {
        Map<String, Long> states = new TreeMap<>();
        view.all(topic).forEach(each -> states.merge(each.path(STATE).asText("none"), 1L, Long::sum));
        GaugeSnapshot.Builder gauge = gauge(name, help);
        states.forEach((state, count) -> gauge.dataPoint(value(Labels.of(STATE, state), count)));
        return gauge.build();
    }

    private static GaugeSnapshot.Builder gauge(String name, String help) {
        return GaugeSnapshot.builder().name("furrow_control_" + name).help(help);
    }

    private static GaugeDataPointSnapshot value(Labels labels, double value) {
        return GaugeDataPointSnapshot.builder().labels(labels).value(value).build();
    }

    private static CounterDataPointSnapshot point(Labels labels, double value) {
        return CounterDataPointSnapshot.builder().labels(labels).value(value).build();
    }

    private byte[] write(MetricSnapshots metrics) {
        ByteArrayOutputStream page = new ByteArrayOutputStream();
        try {
            writer.write(page, metrics);
        } catch (IOException e) {
            throw new UncheckedIOException("memory cannot fail", e);
        }
        return page.toByteArray();
    }
}
