package io.furrow.connect.repair;

import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.function.Function;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.broker.BrokerException;
import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.repair.EntityRequests.NotifiedAttributes;
import io.furrow.connect.repair.EntityRequests.Range;
import io.furrow.connect.repair.KeysetReader.Page;
import io.furrow.connect.subscription.NotificationContent;
import io.furrow.connect.subscription.Subject;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.LogText;
import io.furrow.model.time.Instants;

/**
 * Reads the entities of one subscription from a context broker. A page that needs more heap than allowed, or that
 * cannot be read, is requested in smaller parts, down to the single entity that causes it; of that entity only id, type
 * and time are read. A page has at least two entities: the next page begins with the last entity of the previous one,
 * which shows whether the order has changed. Not thread-safe.
 */
public final class BrokerEntities {
    private static final Logger LOG = LoggerFactory.getLogger(BrokerEntities.class);

    private static final String SERVICE_PATH = "servicePath";
    private static final String MODIFIED = "dateModified";
    private static final String CREATED = "dateCreated";
    /** A parsed answer needs at most this many times the bytes of its body. */
    private static final int TREE_TO_BODY = 4;

    private static final int PAIR = 2;
    private static final int MAX_QUOTED = 256;
    /** The paths that a header can carry. */
    private static final Pattern PATH = Pattern.compile("/[!-~]*");

    private final Function<BrokerRequest, Outcome> broker;
    private final FiwareScope scope;
    private final Subject subject;
    private final NotifiedAttributes notifiedAttributes;
    private final boolean isPathTold;
    private final long maxBytes;
    private int fitting = Integer.MAX_VALUE;

    /**
     * @param scope the tenant, and the service path of the subscription, {@code /#} for all
     * @param notificationContent of the subscription: a read entity must result in the same event as its notification
     * @param maxBytes of a page's body
     */
    public BrokerEntities(
            Function<BrokerRequest, Outcome> broker,
            FiwareScope scope,
            Subject subject,
            NotificationContent notificationContent,
            long maxBytes) {
        this.broker = broker;
        this.scope = scope;
        this.subject = subject;
        this.maxBytes = maxBytes;
        isPathTold = notificationContent.attrs().contains(SERVICE_PATH);
        Set<String> attrs =
                new LinkedHashSet<>(notificationContent.attrs().isEmpty() ? List.of("*") : notificationContent.attrs());
        attrs.remove("alterationType");
        attrs.addAll(List.of(MODIFIED, SERVICE_PATH));
        notifiedAttributes = new NotifiedAttributes(attrs, notificationContent.metadata());
    }

    /** The entities modified at or after a time, oldest first. */
    public Page modifiedFrom(Instant from, int offset, int limit) throws BrokerException, InterruptedException {
        return page(new Range(MODIFIED, from, offset, limit), notifiedAttributes);
    }

    /** The entities created at or after a time, oldest first; of the attributes only the built-in ones. */
    Page createdFrom(Instant from, int offset, int limit) throws BrokerException, InterruptedException {
        return page(new Range(CREATED, from, offset, limit), builtIns(CREATED));
    }

    /** The current entities of an id, in the order of their times; empty if it was deleted. */
    List<EntityState> ofId(FiwareScope place, String id) throws BrokerException, InterruptedException {
        try {
            JsonNode answer = ask(place, EntityRequests.ofId(id, notifiedAttributes), TREE_TO_BODY * maxBytes);
            List<EntityState> states = states(answer, MODIFIED, Instant.EPOCH);
            states.sort(Comparator.comparing(EntityState::time));
            return states;
        } catch (UnreadableException e) {
            inParts(e);
        }
        List<EntityState> states = new ArrayList<>();
        for (EntityState stub : stubsOfId(place, id, MODIFIED)) {
            whole(stub).ifPresent(states::add);
        }
        return states;
    }

    /** The same, without their attributes. */
    List<EntityState> stubsOfId(FiwareScope place, String id) throws BrokerException, InterruptedException {
        return stubsOfId(place, id, CREATED);
    }

    private List<EntityState> stubsOfId(FiwareScope place, String id, String order)
            throws BrokerException, InterruptedException {
        return states(stubs(place, EntityRequests.ofId(id, builtIns(order))), order, Instant.EPOCH);
    }

    /** Whether an entity belongs to the subscription. */
    boolean covers(EntityState state) {
        return subject.covers(state.entity().id(), state.entity().type());
    }

    private Page page(Range range, NotifiedAttributes desired) throws BrokerException, InterruptedException {
        int limit = Math.min(range.limit(), fitting);
        while (true) {
            try {
                JsonNode answer =
                        ask(scope, EntityRequests.page(range.first(limit), subject, desired), TREE_TO_BODY * maxBytes);
                return new Page(states(answer, range.order(), range.from()), limit, answer.size() >= limit);
            } catch (UnreadableException e) {
                inParts(e);
            }
            if (limit == PAIR) {
                return pair(range.first(PAIR));
            }
            limit = Math.max(PAIR, limit / 2);
            fitting = limit;
        }
    }

    /** The next two entities of the context broker, each read individually. */
    private Page pair(Range range) throws BrokerException, InterruptedException {
        JsonNode stubs = stubs(scope, EntityRequests.page(range, subject, builtIns(range.order())));
        List<EntityState> states = new ArrayList<>();
        for (EntityState stub : states(stubs, range.order(), range.from())) {
            boolean isWhole = range.order().equals(CREATED) || stub.problem().isPresent();
            (isWhole ? Optional.of(stub) : whole(stub)).ifPresent(states::add);
        }
        return new Page(states, PAIR, stubs.size() == PAIR);
    }

    private static NotifiedAttributes builtIns(String order) {
        return new NotifiedAttributes(new LinkedHashSet<>(List.of(order, SERVICE_PATH)), List.of());
    }

    /**
     * The entity with all attributes, at the time of its stub, behind which others may follow; empty if it was deleted.
     */
    private Optional<EntityState> whole(EntityState stub) throws BrokerException, InterruptedException {
        String path = EntityRequests.ofType(stub.entity().id(), stub.entity().type(), notifiedAttributes);
        try {
            return states(ask(stub.scope(), path, TREE_TO_BODY * maxBytes / PAIR), MODIFIED, stub.time()).stream()
                    .findFirst()
                    .map(state -> new EntityState(state.entity(), state.scope(), stub.time(), state.problem()));
        } catch (UnreadableException e) {
            return Optional.of(new EntityState(stub.entity(), stub.scope(), stub.time(), Optional.of(e)));
        }
    }

    /** An entity without a time gets the time of its predecessor, or the least. */
    private List<EntityState> states(JsonNode entities, String order, Instant least) {
        List<EntityState> states = new ArrayList<>();
        Instant time = least;
        for (JsonNode json : entities) {
            time = Instants.of(json.path(order).path("value"))
                    .map(own -> own.truncatedTo(ChronoUnit.MILLIS))
                    .orElse(time);
            states.add(state(json, order, time));
        }
        return states;
    }

    private EntityState state(JsonNode json, String order, Instant time) {
        String path = json.path(SERVICE_PATH).path("value").asText("/");
        boolean isPath = PATH.matcher(path).matches();
        FiwareScope place = new FiwareScope(scope.service(), isPath ? path : "/");
        try {
            if (!isPath) {
                throw new UnreadableException(
                        Reason.NOT_AN_ENTITY, "its servicePath is invalid: " + LogText.beginning(path));
            }
            Entity entity = Entity.of(json);
            if (order.equals(MODIFIED) && !isPathTold) {
                entity.json().remove(SERVICE_PATH);
            }
            return new EntityState(entity, place, time);
        } catch (UnreadableException e) {
            Entity stub = new Entity(JsonNodeFactory.instance
                    .objectNode()
                    .put("id", idOf(json.path("id")))
                    .put("type", json.path("type").asText()));
            return new EntityState(stub, place, time, Optional.of(e));
        }
    }

    /** An id that is not text as the beginning of its JSON, so that the entity can be found. */
    private static String idOf(JsonNode id) {
        String text = id.isContainerNode() ? id.toString() : id.asText();
        return text.substring(0, Math.min(text.length(), MAX_QUOTED));
    }

    private JsonNode stubs(FiwareScope place, String path) throws BrokerException, InterruptedException {
        String what = "read entities of tenant '" + scope.service() + "'";
        return BrokerException.list(what, BrokerException.success(what, answer(BrokerRequest.get(place, path))));
    }

    private static void inParts(UnreadableException why) {
        LOG.debug("an answer cannot be read and is requested in parts", why);
    }

    /** @throws UnreadableException if the answer is too large or cannot be read */
    private JsonNode ask(FiwareScope place, String path, long maxHeap)
            throws BrokerException, InterruptedException, UnreadableException {
        Outcome outcome = answer(BrokerRequest.get(place, path));
        if (outcome instanceof Outcome.Rejected rejected && rejected.isTooLarge()) {
            throw tooLarge();
        }
        Outcome.Done done = BrokerException.success("read entities of tenant '" + scope.service() + "'", outcome);
        byte[] body = done.body();
        long heap = TreeEstimate.of(body);
        if (body.length > maxBytes || heap > maxHeap) {
            throw tooLarge();
        }
        if (heap < maxBytes && fitting < Integer.MAX_VALUE / 2) {
            fitting *= 2;
        }
        return done.list();
    }

    private UnreadableException tooLarge() {
        return new UnreadableException(
                Reason.TOO_LARGE, "it is larger than " + maxBytes + " bytes; see repair.page.max.bytes");
    }

    private Outcome answer(BrokerRequest request) throws InterruptedException {
        Outcome outcome = broker.apply(request);
        if (Thread.interrupted()) {
            throw new InterruptedException("stopped while it waited for the context broker");
        }
        return outcome;
    }
}
