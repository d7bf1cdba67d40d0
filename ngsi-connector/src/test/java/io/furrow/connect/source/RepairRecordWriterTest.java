package io.furrow.connect.source;

import java.net.http.HttpHeaders;
import java.time.Instant;
import java.util.List;
import java.util.Map;

import org.junit.jupiter.api.Test;

import io.furrow.connect.broker.Outcome;
import io.furrow.connect.broker.ResponseHeaders;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.repair.BrokerEntities;
import io.furrow.connect.repair.EntityState;
import io.furrow.connect.repair.MissedChange;
import io.furrow.connect.source.journal.JournalRecordCodec;
import io.furrow.connect.subscription.NotificationContent;
import io.furrow.connect.subscription.Subject;
import io.furrow.model.event.FiwareScope;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

class RepairRecordWriterTest {
    private static final Instant T = Instant.parse("2026-11-21T12:00:00Z");
    private static final String PAGE = """
            [{"id": {"type": "Text", "value": "x"}, "type": {"type": "Text", "value": "y"}},
             {"id": "p", "type": "Probe", "servicePath": {"value": "no path"}},
             {"id": "d", "type": "Probe", "big": {"value": 1e5000}}]""";

    private final RepairRecordWriter records = new RepairRecordWriter(
            new NgsiSourceConfig(Map.of("journal.dir", "/tmp/journal")).translation(), null, new Ledger());

    @Test
    void givesEachEntityThatCannotBeReadItsReason() throws Exception {
        BrokerEntities entities = new BrokerEntities(
                request -> new Outcome.Done(
                        200,
                        new ResponseHeaders(HttpHeaders.of(Map.of(), (name, value) -> true)),
                        PAGE.getBytes(UTF_8)),
                new FiwareScope("agri", "/#"),
                Subject.ANY,
                new NotificationContent(List.of("*", "dateModified"), "normalized", false),
                1 << 20);

        List<KafkaRecord> dead = entities.modifiedFrom(T, 0, 8).states().stream()
                .map(this::deadLetter)
                .toList();

        assertThat(dead)
                .extracting(each -> each.headers().get("dead-reason"), each -> new String(each.value(), UTF_8))
                .containsExactly(
                        tuple("not-an-entity", "{\"type\":\"Text\",\"value\":\"x\"}"),
                        tuple("not-an-entity", "p"),
                        tuple("too-deep", "d"));
        assertThat(dead.get(0).headers().get("dead-message"))
                .isEqualTo(
                        "the entity {\"type\":\"Text\",\"value\":\"x\"} of the context broker cannot be read: the entity has no member 'id' with a text");
    }

    private KafkaRecord deadLetter(EntityState state) {
        return JournalRecordCodec.read(records.serialize("s", new MissedChange.Unreadable(state, T)));
    }
}
