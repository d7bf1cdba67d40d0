package io.furrow.connect.repair;

import java.net.URLEncoder;
import java.nio.charset.StandardCharsets;
import java.time.DateTimeException;
import java.time.Instant;
import java.time.OffsetDateTime;
import java.time.temporal.ChronoUnit;
import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import java.util.function.Function;

import com.fasterxml.jackson.databind.JsonNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.LogText;
import io.furrow.connect.broker.BrokerException;
import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.repair.KeysetReader.Page;
import io.furrow.connect.subscription.Subject;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

/** Asks a context broker for the entities of one subscription, with {@code GET /v2/entities}. */
final class BrokerEntities {
    private static final Logger LOG = LoggerFactory.getLogger(BrokerEntities.class);

    private static final String SERVICE_PATH = "servicePath";
    private static final String MODIFIED = "dateModified";
    private static final String CREATED = "dateCreated";
    /** 409: more than one entity has this id. */
    private static final int SEVERAL = 409;

    private final Function<BrokerRequest, Outcome> broker;
    private final FiwareScope scope;
    private final Subject subject;
    private final List<String> attrs;

    /**
     * @param scope the tenant, and the service path of the subscription, {@code /#} for all
     * @param attrs of the subscription: what is read must make the same event as its notification
     */
    BrokerEntities(Function<BrokerRequest, Outcome> broker, FiwareScope scope, Subject subject, List<String> attrs) {
        this.broker = broker;
        this.scope = scope;
        this.subject = subject;
        this.attrs = List.copyOf(attrs);
    }

    /** What was modified at or after a time, oldest first. */
    Page modifiedFrom(Instant from, int offset, int limit) throws BrokerException, InterruptedException {
        Set<String> wanted = new LinkedHashSet<>(attrs.isEmpty() ? List.of("*") : attrs);
        wanted.remove("alterationType");
        wanted.addAll(List.of(MODIFIED, SERVICE_PATH));
        Page page = page(MODIFIED, wanted, new Range(from, offset, limit));
        if (!attrs.contains(SERVICE_PATH)) {
            page.states().forEach(state -> state.entity().json().remove(SERVICE_PATH));
        }
        return page;
    }

    /** What was created at or after a time, oldest first; of the attributes only the built-in ones. */
    Page createdFrom(Instant from, int offset, int limit) throws BrokerException, InterruptedException {
        return page(CREATED, Set.of(CREATED, SERVICE_PATH), new Range(from, offset, limit));
    }

    /** Whether the context broker has an entity of this id, of any type. */
    boolean isPresent(FiwareScope place, String id) throws BrokerException, InterruptedException {
        Outcome outcome = answer(BrokerRequest.get(place, "/v2/entities/" + encoded(id) + "?attrs=" + SERVICE_PATH));
        if (outcome instanceof Outcome.Refused refused && refused.status() == SEVERAL) {
            return true;
        }
        if (outcome instanceof Outcome.Absent) {
            return false;
        }
        BrokerException.success("look for an entity of " + tenant(), outcome);
        return true;
    }

    private record Range(Instant from, int offset, int limit) {}

    private Page page(String order, Set<String> wanted, Range range) throws BrokerException, InterruptedException {
        StringBuilder query = new StringBuilder("/v2/entities?orderBy=")
                .append(order)
                .append(",id&q=")
                .append(encoded(order + ">=" + range.from().truncatedTo(ChronoUnit.MILLIS)))
                .append("&limit=")
                .append(range.limit())
                .append("&attrs=")
                .append(encoded(String.join(",", wanted)));
        if (range.offset() > 0) {
            query.append("&offset=").append(range.offset());
        }
        if (!subject.idPattern().equals(".*")) {
            query.append("&idPattern=").append(encoded(subject.idPattern()));
        }
        if (!subject.types().isEmpty()) {
            query.append("&type=").append(encoded(String.join(",", subject.types())));
        }
        subject.typePattern().ifPresent(pattern -> query.append("&typePattern=").append(encoded(pattern)));
        JsonNode answer = ask("read entities", scope, query.toString());
        List<EntityState> states = new ArrayList<>();
        answer.forEach(json -> add(states, json, order));
        return new Page(states, answer.size() >= range.limit());
    }

    private void add(List<EntityState> states, JsonNode json, String order) {
        try {
            Entity entity = Entity.of(json);
            Instant time = OffsetDateTime.parse(entity.text(order).orElse(""))
                    .toInstant()
                    .truncatedTo(ChronoUnit.MILLIS);
            states.add(new EntityState(entity, scopeOf(json), time));
        } catch (UnreadableException | DateTimeException e) {
            LOG.warn(
                    "an entity of tenant '{}' cannot be read and is left out: {}",
                    scope.service(),
                    LogText.oneLine(e.getMessage()));
        }
    }

    private FiwareScope scopeOf(JsonNode json) {
        String path = json.path(SERVICE_PATH).path("value").asText("/");
        return new FiwareScope(scope.service(), path);
    }

    private JsonNode ask(String what, FiwareScope place, String query) throws BrokerException, InterruptedException {
        String where = what + " of " + tenant();
        return BrokerException.json(where, BrokerException.success(where, answer(BrokerRequest.get(place, query))));
    }

    private Outcome answer(BrokerRequest request) throws InterruptedException {
        Outcome outcome = broker.apply(request);
        if (Thread.interrupted()) {
            throw new InterruptedException("stopped while it waited for the context broker");
        }
        return outcome;
    }

    private String tenant() {
        return "tenant '" + scope.service() + "'";
    }

    private static String encoded(String text) {
        return URLEncoder.encode(text, StandardCharsets.UTF_8).replace("+", "%20");
    }
}
