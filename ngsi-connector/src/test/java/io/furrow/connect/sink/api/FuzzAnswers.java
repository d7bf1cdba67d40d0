package io.furrow.connect.sink.api;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashSet;
import java.util.List;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.connect.broker.Script;
import io.furrow.connect.broker.ScriptedBroker;
import io.furrow.connect.broker.ScriptedBroker.Exchange;
import io.furrow.connect.sink.api.ContextWriter.ChangeResults;
import io.furrow.connect.sink.api.ContextWriter.RejectedChange;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * What a fuzzer throws at the sink: the first byte picks the API and when batches are taken apart, the others are the answers of
 * a {@link Script}. Whatever they are, each change of a delivery has one fate, or all of it is put off or fails as declared; what
 * counts as written or deleted was confirmed, and the words of a refusal fit on a line.
 */
public final class FuzzAnswers {
    private static final FiwareScope SCOPE = new FiwareScope("farm", "/");
    private static final int TRIES = 3;
    private static final int MAX_WORDS_LENGTH = 7000;
    private static final long MAX_ANSWER = 1 << 16;
    private static final List<EntityChange> DELIVERY = delivery();

    private FuzzAnswers() {}

    /** Called by the fuzzer first: loading classes takes long on a busy machine, and no input hangs because of it. */
    public static void fuzzerInitialize() {
        fuzzerTestOneInput("0".getBytes(UTF_8));
        fuzzerTestOneInput("1".getBytes(UTF_8));
    }

    /** The answers to one delivery; throws whatever is wrong. */
    public static void fuzzerTestOneInput(byte[] input) {
        if (input.length == 0) {
            return;
        }
        boolean isLd = (input[0] & 1) == 1;
        ScriptedBroker broker = new ScriptedBroker(new Script(
                Arrays.copyOfRange(input, 1, input.length),
                (method, path) -> isRead(method, path) ? Script.Reply.of(200, "[]") : Script.Reply.of(204, "")));
        try (ContextWriter writer = new ContextWriter(
                broker.client(MAX_ANSWER),
                isLd ? new NgsiLd("") : new NgsiV2("TimeInstant"),
                new EntityTimesCache(1000, Duration.ofMinutes(10), System::nanoTime),
                new Batches(4, 10_000),
                1,
                new Isolation((input[0] & 2) == 2 ? 1 : 0, (input[0] & 4) == 4 ? 1 : 0))) {
            for (int i = 0; i < TRIES; i++) {
                try {
                    check(writer.apply(DELIVERY), broker.exchanges(), isLd);
                    return;
                } catch (BrokerUnavailableException putOff) {
                    requireLine(putOff.getMessage());
                } catch (WrongSettingException failed) {
                    requireLine(failed.getMessage());
                    return;
                }
            }
        }
    }

    private static List<EntityChange> delivery() {
        List<EntityChange> changes = new ArrayList<>();
        for (String id : List.of("urn:x:u0", "urn:x:u1", "urn:x:u2", "urn:x:u3", "urn:x:u4", "urn:x:u0")) {
            Entity entity = Entity.builder(id, "T").integer("x", changes.size()).build();
            changes.add(new EntityChange(
                    new EntityKey(SCOPE, id), entity.type(), entity, 1_000 + changes.size(), changes.size()));
        }
        for (String id : List.of("urn:x:d0", "urn:x:d1", "urn:x:d2")) {
            changes.add(new EntityChange(new EntityKey(SCOPE, id), "", null, 1_000 + changes.size(), changes.size()));
        }
        return List.copyOf(changes);
    }

    private static boolean isRead(String method, String path) {
        return method.equals("GET") || path.startsWith("/v2/op/query");
    }

    private static void check(ChangeResults changeResults, List<Exchange> exchanges, boolean isLd) {
        require(
                changeResults.written
                                + changeResults.coalesced
                                + changeResults.stale
                                + changeResults.deleted
                                + changeResults.refused.size()
                        == DELIVERY.size(),
                "the fates are not as many as the changes");
        Set<String> settled = new HashSet<>();
        for (RejectedChange refused : changeResults.refused) {
            requireLine(refused.words());
            settled.add(refused.entityChange().key().id());
        }
        Set<String> tried = new HashSet<>();
        for (Exchange exchange : exchanges) {
            if (isRead(exchange.method(), exchange.path())) {
                Set<String> shown = shown(exchange);
                tried.stream()
                        .filter(id -> shown != null && !shown.contains(id))
                        .forEach(settled::add);
            } else {
                List<String> ids = ids(exchange);
                ids.stream().filter(id -> isConfirmed(exchange, id, ids, isLd)).forEach(settled::add);
                ids.stream().filter(id -> id.contains("d")).forEach(tried::add);
            }
        }
        if (changeResults.stale == 0) {
            DELIVERY.forEach(entityChange -> require(
                    settled.contains(entityChange.key().id()),
                    entityChange.key().id() + " was confirmed by no answer"));
        }
    }

    private static List<String> ids(Exchange exchange) {
        List<String> ids = new ArrayList<>();
        if (exchange.method().equals("DELETE")) {
            ids.add(java.net.URLDecoder.decode(exchange.path().replaceAll(".*/entities/([^/?]*).*", "$1"), UTF_8));
        } else {
            JsonNode body = json(exchange.body()).orElseThrow();
            (body.isArray() ? body : body.path("entities"))
                    .forEach(one -> ids.add(
                            one.isTextual() ? one.asText() : one.path("id").asText()));
        }
        return ids;
    }

    /** An answer 207 confirms what it names as a success, or all but the errors where each of them is of the request. */
    private static boolean isConfirmed(Exchange exchange, String id, List<String> asked, boolean isLd) {
        if (exchange.method().equals("DELETE") && exchange.reply().status() == 404) {
            return true;
        }
        if (!exchange.isSuccess() || !isLd || exchange.reply().status() != 207) {
            return exchange.isSuccess();
        }
        JsonNode answer = json(exchange.reply().body()).orElse(NgsiJson.mapper().missingNode());
        Set<String> errors = new HashSet<>();
        answer.path("errors").forEach(error -> {
            JsonNode of = error.path("entityId");
            errors.add(of.isArray() ? of.path(0).asText() : of.asText());
        });
        Set<String> successes = new HashSet<>();
        answer.path("success").forEach(success -> successes.add(success.asText()));
        boolean allNamed = !errors.isEmpty() && asked.containsAll(errors);
        return !errors.contains(id) && (successes.contains(id) || allNamed);
    }

    /** Null if the answer shows no list; 404 says that there is no such tenant. */
    private static Set<String> shown(Exchange exchange) {
        if (exchange.reply().status() == 404) {
            return Set.of();
        }
        JsonNode list = exchange.isSuccess() ? json(exchange.reply().body()).orElse(null) : null;
        if (list == null || !list.isArray()) {
            return null;
        }
        Set<String> ids = new HashSet<>();
        list.forEach(entity -> ids.add(entity.path("id").asText()));
        return ids;
    }

    private static Optional<JsonNode> json(byte[] body) {
        try {
            return Optional.of(NgsiJson.read(body));
        } catch (UnreadableException e) {
            return Optional.empty();
        }
    }

    private static void requireLine(String words) {
        require(words.length() <= MAX_WORDS_LENGTH, "words of " + words.length() + " signs");
        require(
                words.chars().noneMatch(sign -> Character.isISOControl(sign) || sign == 0x2028 || sign == 0x2029),
                "words of several lines: " + words);
    }

    private static void require(boolean right, String message) {
        if (!right) {
            throw new IllegalStateException(message);
        }
    }
}
