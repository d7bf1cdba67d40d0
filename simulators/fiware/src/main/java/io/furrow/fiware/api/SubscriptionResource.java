package io.furrow.fiware.api;

import java.security.SecureRandom;
import java.util.List;
import java.util.concurrent.atomic.AtomicInteger;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.fiware.broker.ContextBroker;
import io.furrow.fiware.broker.Notifier;
import io.furrow.fiware.broker.Subscription;
import io.furrow.fiware.broker.SubscriptionDefinition;
import io.furrow.fiware.broker.SubscriptionReader;
import io.furrow.fiware.http.NgsiError;
import io.furrow.fiware.http.NgsiRequest;
import io.furrow.fiware.http.NgsiResponse;
import io.furrow.fiware.http.PathFilter;

/** {@code /v2/subscriptions} and {@code /v2/subscriptions/<id>}. A new subscription causes no notification. */
final class SubscriptionResource {
    private static final int ID_LENGTH = 24;

    private final ContextBroker broker;
    private final Notifier notifier;
    private final long instance = new SecureRandom().nextLong(1L << 40);
    private final AtomicInteger created = new AtomicInteger();

    SubscriptionResource(ContextBroker broker, Notifier notifier) {
        this.broker = broker;
        this.notifier = notifier;
    }

    NgsiResponse answer(NgsiRequest call) throws NgsiError {
        if (call.path().size() == 2) {
            return switch (call.method()) {
                case "GET" -> list(call);
                case "POST" -> create(call);
                default -> throw NgsiError.badMethod();
            };
        }
        if (call.path().size() > 3) {
            throw NgsiError.noService();
        }
        return switch (call.method()) {
            case "GET" -> NgsiResponse.ok(find(call).json(broker.now()));
            case "PATCH" -> patch(call);
            case "DELETE" -> delete(call);
            default -> throw NgsiError.badMethod();
        };
    }

    private NgsiResponse create(NgsiRequest call) throws NgsiError {
        SubscriptionDefinition definition = SubscriptionReader.read(call.json());
        Subscription subscription = broker.subscribe(call.service(), nextId(), call.paths(), definition);
        return NgsiResponse.created("/v2/subscriptions/" + subscription.id());
    }

    private NgsiResponse patch(NgsiRequest call) throws NgsiError {
        Subscription subscription = find(call);
        JsonNode patch = call.json();
        if (!patch.isObject() || patch.isEmpty()) {
            throw NgsiError.badRequest("empty payload");
        }
        ObjectNode merged = subscription.definition().requested();
        merged.setAll((ObjectNode) patch);
        subscription.redefine(SubscriptionReader.read(merged), patch.has("status"));
        return NgsiResponse.noContent();
    }

    private NgsiResponse delete(NgsiRequest call) throws NgsiError {
        Subscription subscription = find(call);
        broker.tenant(call.service()).remove(subscription);
        notifier.forget(subscription.id());
        return NgsiResponse.noContent();
    }

    private NgsiResponse list(NgsiRequest call) throws NgsiError {
        List<Subscription> all = visible(call);
        ArrayNode page = JsonNodeFactory.instance.arrayNode();
        all.stream()
                .skip(call.offset())
                .limit(call.limit())
                .map(subscription -> subscription.json(broker.now()))
                .forEach(page::add);
        return NgsiResponse.page(call, page, all.size());
    }

    private Subscription find(NgsiRequest call) throws NgsiError {
        String id = call.path().get(2);
        if (id.length() != ID_LENGTH) {
            throw NgsiError.badRequest("Invalid subscription ID: bad length - 24 chars expected");
        }
        return visible(call).stream()
                .filter(subscription -> subscription.id().equals(id))
                .findFirst()
                .orElseThrow(NgsiError::noSubscription);
    }

    /** Those created under the service path of the request; without one, all of the tenant. */
    private List<Subscription> visible(NgsiRequest call) throws NgsiError {
        PathFilter paths = call.paths();
        return broker.tenant(call.service()).subscriptions().stream()
                .filter(subscription -> paths.patterns().equals(List.of(PathFilter.EVERYWHERE))
                        || subscription.paths().equals(paths))
                .toList();
    }

    /** 24 hexadecimal digits that grow, like an ObjectId: seconds, this instance, a count. */
    private String nextId() {
        return String.format(
                "%08x%010x%06x", broker.now().getEpochSecond(), instance, created.incrementAndGet() & 0xffffff);
    }
}
