package io.furrow.kafka.field;

import java.util.List;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.Test;

import io.furrow.model.field.FieldVersion;

import static org.assertj.core.api.Assertions.assertThat;

class FieldChangeTest {
    @Test
    void comparesWithWhatHoldsAtThatTime() throws Exception {
        List<FieldVersion> known = List.of(
                FieldVersion.read(field("same", 10, 1).toBytes()),
                field("moved", 10, 1),
                field("ended", 10, 1),
                end("ended", 20),
                field("later", 90, 1));

        List<FieldChange> changes = FieldChange.of(
                List.of(field("same", 50, 1), field("moved", 50, 2), field("ended", 50, 1), field("later", 50, 1)),
                known,
                FieldChange.NONE,
                50);

        assertThat(changes)
                .extracting(FieldChange::kind)
                .containsExactly(
                        FieldChange.Kind.UNCHANGED, FieldChange.Kind.CHANGED,
                        FieldChange.Kind.ADDED, FieldChange.Kind.ADDED);
    }

    @Test
    void endsWhatIsNotAmongThemOnlyWhereTheyReplaceAll() {
        var known = List.of(field("gone", 10, 1), field("past", 10, 1), end("past", 20), field("to come", 90, 1));

        assertThat(FieldChange.of(List.of(), known, FieldChange.NONE, 50)).isEmpty();
        assertThat(FieldChange.of(List.of(), known, field -> true, 50))
                .singleElement()
                .satisfies(change -> {
                    assertThat(change.kind()).isEqualTo(FieldChange.Kind.ENDED);
                    assertThat(change.version().id()).isEqualTo("gone");
                    assertThat(change.version().validFrom()).isEqualTo(50);
                    assertThat(change.version().isEnd()).isTrue();
                });
    }

    @Test
    void endsNoFieldOfAnotherDomain() {
        var known = List.of(of("gone", "north"), of("held", "north"), of("other", "south"), of("no", ""));

        List<FieldChange> changes = FieldChange.of(
                List.of(of("held", "north")), known, field -> field.domain().equals("north"), 50);

        assertThat(changes)
                .extracting(change -> change.kind() + " " + change.version().id() + " of "
                        + change.before().domain())
                .containsExactly("UNCHANGED held of north", "ENDED gone of north");
    }

    private static FieldVersion of(String id, String domain) {
        FieldVersion field = field(id, 10, 1);
        field.properties().put("Domain", domain);
        return field;
    }

    private static FieldVersion field(String id, long validFrom, double size) {
        ObjectNode area = JsonNodeFactory.instance.objectNode().put("type", "Polygon");
        area.putArray("coordinates").addArray().addArray().add(0.0).add(size);
        ObjectNode properties =
                JsonNodeFactory.instance.objectNode().put("rows", 12).put("slope", 0.5);
        return new FieldVersion(id, validFrom, area, properties);
    }

    private static FieldVersion end(String id, long validFrom) {
        return new FieldVersion(id, validFrom, null, JsonNodeFactory.instance.objectNode());
    }
}
