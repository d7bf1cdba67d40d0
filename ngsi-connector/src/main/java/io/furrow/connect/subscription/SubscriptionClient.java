package io.furrow.connect.subscription;

import java.time.DateTimeException;
import java.time.Instant;
import java.time.ZonedDateTime;
import java.time.format.DateTimeFormatter;
import java.time.temporal.ChronoUnit;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.function.Function;

import com.fasterxml.jackson.databind.JsonNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.broker.BrokerException;
import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.subscription.SubscriptionPlan.Step;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.text.LogText;

/** Maintains one subscription of one tenant in its desired state. Stateless: it looks up its subscription each time. */
public final class SubscriptionClient {
    private static final Logger LOG = LoggerFactory.getLogger(SubscriptionClient.class);

    private static final String PATH = "/v2/subscriptions";
    private static final int PAGE = 1000;

    private final Function<BrokerRequest, Outcome> broker;
    private final DesiredSubscription desired;
    private final FiwareScope scope;

    public SubscriptionClient(Function<BrokerRequest, Outcome> broker, DesiredSubscription desired) {
        this.broker = broker;
        this.desired = desired;
        this.scope = desired.scope();
    }

    /**
     * Polls the subscription and creates or changes it if it differs from the desired one.
     *
     * @throws BrokerException if the context broker is unavailable or rejects a request; completed steps stay
     */
    public SubscriptionStatus keep(Instant now) throws BrokerException {
        Listing listing = list(now);
        SubscriptionPlan plan = SubscriptionPlan.of(desired, listing.subscriptions(), now);
        Optional<String> created = Optional.empty();
        for (Step step : plan.steps()) {
            Optional<String> id = take(step);
            created = id.isPresent() ? id : created;
        }
        if (created.isPresent()) {
            return new SubscriptionStatus(
                    created.get(),
                    SubscriptionStatus.State.CREATED,
                    DeliveryReport.NOTHING_SENT,
                    listing.at(),
                    lastSuccess(plan));
        }
        JsonNode current = plan.current().orElseThrow();
        return new SubscriptionStatus(
                SubscriptionPlan.id(current), state(plan), DeliveryReport.of(current), listing.at(), Optional.empty());
    }

    private static SubscriptionStatus.State state(SubscriptionPlan plan) {
        boolean resumed = plan.steps().stream()
                .anyMatch(step -> step instanceof Step.Change change
                        && (change.members().contains("status")
                                || change.members().contains("url")
                                || change.members().contains("entities")));
        return resumed ? SubscriptionStatus.State.RESUMED : SubscriptionStatus.State.AT_WORK;
    }

    private static Optional<Instant> lastSuccess(SubscriptionPlan plan) {
        return plan.leftovers().stream()
                .map(DeliveryReport::of)
                .flatMap(report -> report.lastSuccess().stream())
                .min(Instant::compareTo);
    }

    private record Listing(List<JsonNode> subscriptions, Instant at) {}

    private Listing list(Instant now) throws BrokerException {
        List<JsonNode> all = new ArrayList<>();
        Instant at = now;
        int found = PAGE;
        for (int offset = 0; found == PAGE; offset += PAGE) {
            String what = "list subscriptions of " + place();
            Outcome.Done done = BrokerException.success(
                    what, broker.apply(BrokerRequest.get(scope, PATH + "?limit=" + PAGE + "&offset=" + offset)));
            at = offset == 0 ? date(done).orElse(now.truncatedTo(ChronoUnit.SECONDS)) : at;
            JsonNode page = BrokerException.list(what, done);
            page.forEach(all::add);
            found = page.size();
        }
        return new Listing(all, at);
    }

    /** The clock of {@code dateModified}; the header is truncated to the second, and never ahead. */
    private static Optional<Instant> date(Outcome.Done done) {
        return done.headers().first("Date").flatMap(text -> {
            try {
                return Optional.of(ZonedDateTime.parse(text, DateTimeFormatter.RFC_1123_DATE_TIME)
                        .toInstant());
            } catch (DateTimeException e) {
                return Optional.empty();
            }
        });
    }

    /** @return the id of the created subscription */
    private Optional<String> take(Step step) throws BrokerException {
        if (step instanceof Step.Create create) {
            Outcome.Done done = BrokerException.success(
                    "subscribe at " + place(), broker.apply(BrokerRequest.create(scope, PATH, create.json())));
            LOG.info(
                    "subscribed at {} as '{}', notified at {}",
                    place(),
                    desired.name().text(),
                    desired.target().url());
            return Optional.of(done.headers().createdId().orElse(""));
        }
        if (step instanceof Step.Change change) {
            BrokerException.success(
                    "change our subscription " + change.id() + " at " + place(),
                    broker.apply(BrokerRequest.patch(scope, PATH + "/" + change.id(), change.json())));
            LOG.info("changed {} of subscription {} at {}", change.members(), change.id(), place());
            return Optional.empty();
        }
        Step.Remove remove = (Step.Remove) step;
        Outcome outcome = broker.apply(BrokerRequest.delete(scope, PATH + "/" + remove.id()));
        if (!(outcome instanceof Outcome.Absent)) {
            BrokerException.success("remove subscription " + remove.id() + " at " + place(), outcome);
            LOG.info("removed subscription {} '{}' at {}", remove.id(), LogText.oneLine(remove.description()), place());
        }
        return Optional.empty();
    }

    private String place() {
        return "tenant '" + scope.service() + "', path " + scope.servicePath();
    }
}
