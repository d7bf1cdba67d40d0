package io.furrow.connect.repair;

import java.io.IOException;
import java.net.URLEncoder;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.BrokerException;
import io.furrow.connect.broker.Script;
import io.furrow.connect.broker.ScriptedBroker;
import io.furrow.connect.broker.ScriptedBroker.Exchange;
import io.furrow.connect.repair.KeysetReader.Page;
import io.furrow.connect.source.FuzzOutput;
import io.furrow.connect.subscription.NotificationContent;
import io.furrow.connect.subscription.Subject;
import io.furrow.files.Folders;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * What a fuzzer throws at the reading of a repair: the answers of a {@link Script} to what it asks of a context broker. Whatever
 * they are, the repair ends, or throws what it declares; an entity of a page that it took is a record or a dead letter, and
 * nothing is told as deleted that the context broker did not show as absent.
 */
public final class FuzzPages {
    private static final FiwareScope EVERYWHERE = new FiwareScope("agri", "/#");
    private static final FiwareScope ROOT = new FiwareScope("agri", "/");
    private static final Instant START = Instant.parse("2026-11-21T12:00:00Z");
    private static final NotificationContent CONTENT =
            new NotificationContent(List.of("*", "dateModified"), "normalized", false);
    private static final int PAGE = 8;
    private static final long MAX_BYTES = 3000;
    private static final long MAX_ANSWER = 3500;

    private FuzzPages() {}

    /** Called by the fuzzer first: loading classes takes long on a busy machine, and no input hangs because of it. */
    public static void fuzzerInitialize() throws IOException, InterruptedException {
        fuzzerTestOneInput("0[{\"id\": \"a\"}]".getBytes(UTF_8));
    }

    /** The answers to one repair; throws whatever is wrong. */
    public static void fuzzerTestOneInput(byte[] input) throws IOException, InterruptedException {
        readPage(input);
        Path folder = Files.createTempDirectory("furrow-fuzz");
        try {
            repair(input, folder);
        } finally {
            Folders.delete(folder);
        }
    }

    private static BrokerEntities entities(ScriptedBroker broker) {
        BrokerClient client = broker.client(MAX_ANSWER);
        return new BrokerEntities(client::send, EVERYWHERE, Subject.ANY, CONTENT, MAX_BYTES);
    }

    private static ScriptedBroker broker(byte[] input) {
        return new ScriptedBroker(new Script(input, (method, path) -> Script.Reply.of(200, "[]")));
    }

    /** A page has a state of each entity that was shown, but for those that were gone when they were asked for. */
    private static void readPage(byte[] input) throws InterruptedException {
        ScriptedBroker broker = broker(input);
        Page page;
        try {
            page = entities(broker).modifiedFrom(START, 0, PAGE);
        } catch (BrokerException declared) {
            return;
        }
        List<Exchange> exchanges = broker.exchanges();
        int listing = exchanges.size() - 1;
        long gone = 0;
        while (!exchanges.get(listing).path().contains("orderBy=")) {
            gone += shown(exchanges.get(listing)).filter(JsonNode::isEmpty).isPresent() ? 1 : 0;
            listing--;
        }
        JsonNode shown = shown(exchanges.get(listing))
                .orElseThrow(() -> new IllegalStateException("a page of what is not a list of entities"));
        require(page.states().size() + gone == shown.size(), "an entity of the page is lost");
    }

    private static void repair(byte[] input, Path folder) throws IOException, InterruptedException {
        ScriptedBroker broker = broker(input);
        RecordTracker live = new RecordTracker(1 << 20);
        FuzzOutput output = new FuzzOutput();
        try (EntityIdSet known = EntityIdSet.open(folder.resolve("known"), 1 << 20)) {
            known.add(ROOT.identity("T", "known"));
            live.restoreStale(List.of(ROOT.identity("T", "stale")));
            Repair repair = new Repair(
                    entities(broker),
                    new RepairSettings.Reading(PAGE, MAX_BYTES, EventTimeRule.within(Duration.ofMinutes(5)), List.of()),
                    live,
                    known,
                    new RepairPublisher(output, live, known, "s"));
            try {
                repair.changesFrom(START);
                requireAllTold(broker.exchanges(), output);
                repair.stale(scope -> true);
                repair.deletions(
                        new ListingSchedule(ROOT, Duration.ZERO, () -> 0), Optional.of(START), known::markStale);
            } catch (BrokerException declared) {
                // it tries again later
            }
        }
        output.deleted.forEach((id, type) -> require(
                broker.exchanges().stream()
                        .filter(exchange -> exchange.path().contains("id=" + URLEncoder.encode(id, UTF_8) + "&"))
                        .anyMatch(exchange -> shown(exchange)
                                .filter(list -> !contains(list, id, type))
                                .isPresent()),
                id + " of type " + type + " is reported as deleted, and was not shown as absent"));
    }

    private static boolean contains(JsonNode list, String id, String type) {
        for (JsonNode entity : list) {
            if (printable(entity.path("id").asText()).equals(id)
                    && printable(entity.path("type").asText("Thing")).equals(type)) {
                return true;
            }
        }
        return false;
    }

    /** Where one answer was all: which of several is asked for again, only the reader knows. */
    private static void requireAllTold(List<Exchange> exchanges, FuzzOutput output) {
        if (exchanges.size() == 1) {
            shown(exchanges.get(0)).orElseThrow().forEach(entity -> {
                String id = entity.path("id").asText();
                require(output.told.contains(printable(id)), "the entity '" + id + "' is lost");
            });
        }
    }

    /** As it is after a way through UTF-8. */
    private static String printable(String text) {
        return new String(text.getBytes(UTF_8), UTF_8);
    }

    /** The list of entities in a success; empty if there is none. */
    private static Optional<JsonNode> shown(Exchange exchange) {
        try {
            return exchange.isSuccess()
                    ? Optional.of(NgsiJson.read(exchange.reply().body())).filter(JsonNode::isArray)
                    : Optional.empty();
        } catch (UnreadableException e) {
            return Optional.empty();
        }
    }

    private static void require(boolean right, String message) {
        if (!right) {
            throw new IllegalStateException(message);
        }
    }
}
