package io.furrow.control.rest;

import java.util.Map;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.LongAdder;
import java.util.function.Function;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.container.ContainerResponseContext;
import jakarta.ws.rs.container.ContainerResponseFilter;
import jakarta.ws.rs.container.PreMatching;

import io.furrow.control.rest.description.ApiDescription;
import io.furrow.control.rest.view.PendingReplies;
import io.furrow.control.rest.view.StateView;
import io.furrow.http.prometheus.MetricsPage;
import io.furrow.http.prometheus.MetricsPage.Point;
import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.Readiness;
import io.furrow.model.topic.Topics;

/** Counts requests, and writes the counts and the content of the view in the text format of Prometheus. */
@PreMatching
final class RestMetrics implements ContainerRequestFilter, ContainerResponseFilter {
    private static final Set<String> METHODS = Set.of("GET", "HEAD", "OPTIONS", "POST", "PATCH", "PUT", "DELETE");
    private static final String STARTED = "furrow.begun";
    private static final String STATE = "state";

    private final StateView view;
    private final PendingReplies answers;
    private final Readiness readiness;
    private final Map<Route, Count> counts = new ConcurrentHashMap<>();

    private record Route(String method, String path, int status) {}

    private record Count(LongAdder requests, LongAdder nanos) {}

    RestMetrics(StateView view, PendingReplies answers, Readiness readiness) {
        this.view = view;
        this.answers = answers;
        this.readiness = readiness;
    }

    @Override
    public void filter(ContainerRequestContext request) {
        request.setProperty(STARTED, System.nanoTime());
    }

    @Override
    public void filter(ContainerRequestContext request, ContainerResponseContext response) {
        String method = METHODS.contains(request.getMethod()) ? request.getMethod() : "other";
        Route route = new Route(method, ApiDescription.path(request), response.getStatus());
        Count count = counts.computeIfAbsent(route, any -> new Count(new LongAdder(), new LongAdder()));
        count.requests().increment();
        if (request.getProperty(STARTED) instanceof Long started) {
            count.nanos().add(System.nanoTime() - started);
        }
    }

    byte[] page() {
        MetricsPage page = new MetricsPage("furrow_control_");
        page.gauge(
                "part_up",
                "1 if a part of this instance or a dependency works.",
                readiness.statuses().stream()
                        .map(part -> new Point(part.state() == ComponentStatus.State.UP ? 1 : 0, "part", part.name())));
        page.counter(
                "answers",
                "Answers of the managers to any client, read since this instance was ready.",
                answers.counts().entrySet().stream()
                        .map(count -> new Point(
                                count.getValue().sum(),
                                "manager",
                                count.getKey().topic(),
                                "status",
                                count.getKey().status())));
        page.counter("requests", "Requests to the REST API that were answered.", points(Count::requests, 1));
        page.counter("request_seconds", "Total seconds between requests and their answers.", points(Count::nanos, 1e9));
        page.gauge("awaited", "Requests that wait for the answer of a manager.", answers.pending());
        page.gauge("view_complete", "1 if the topics were read to their ends.", view.isComplete() ? 1 : 0);
        if (view.isComplete()) {
            page.gauge("missions", "Missions by state.", byState(Topics.MISSIONS_STATUS));
            page.gauge("devices", "Devices by the state that their hosts report.", byState(Topics.DEVICES_STATUS));
            page.gauge("alarms", "Alarms by state.", byState(Topics.ALARMS));
        }
        return page.write();
    }

    private Stream<Point> points(Function<Count, LongAdder> counter, double unit) {
        return counts.entrySet().stream().map(count -> {
            Route route = count.getKey();
            double sum = counter.apply(count.getValue()).sum() / unit;
            return new Point(
                    sum, "method", route.method(), "path", route.path(), "status", Integer.toString(route.status()));
        });
    }

    private Stream<Point> byState(String topic) {
        return view
                .all(topic)
                .collect(Collectors.groupingBy(each -> each.path(STATE).asText("none"), Collectors.counting()))
                .entrySet()
                .stream()
                .map(state -> new Point(state.getValue(), STATE, state.getKey()));
    }
}
