package io.furrow.kafka.field;

import java.util.List;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RejectedException;
import io.furrow.model.field.FieldVersion;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class FieldEditTest {
    private static final String LATER = "@1970-01-01T00:00:00.090Z";

    @Test
    void endsAFieldForGood() throws Exception {
        List<FieldVersion> known = List.of(field("a", 10, "x"), field("a", 90, "x"), field("b", 10, "x"));

        FieldEdit edit = FieldEdit.end("a", 50, known);

        assertThat(edit.written()).singleElement().satisfies(end -> {
            assertThat(end.key()).isEqualTo("a@1970-01-01T00:00:00.050Z");
            assertThat(end.isEnd()).isTrue();
        });
        assertThat(edit.removed()).containsExactly("a" + LATER);
    }

    @Test
    void refusesToEndWhatDoesNotHoldThen() {
        List<FieldVersion> known = List.of(field("a", 10, "x"), FieldChange.end("a", 20));

        refused(ErrorCode.UNKNOWN_FIELD, "there is no field 'b'; there are: a", () -> FieldEdit.end("b", 50, known));
        refused(ErrorCode.UNKNOWN_FIELD, "there is none", () -> FieldEdit.end("b", 50, List.of()));
        refused(ErrorCode.WRONG_STATE, "ended at 1970-01-01T00:00:00.020Z", () -> FieldEdit.end("a", 50, known));
        refused(ErrorCode.WRONG_STATE, "begins at 1970-01-01T00:00:00.010Z", () -> FieldEdit.end("a", 5, known));
    }

    @Test
    void endsWhatADomainHasAndTakesBackWhatItIsToHave() {
        List<FieldVersion> known = List.of(
                field("now", 10, "x"),
                field("over", 10, "x"),
                FieldChange.end("over", 20),
                field("other", 10, "y"),
                field("moved", 10, "y"),
                field("moved", 20, "x"),
                field("planned", 90, "x"),
                field("theirs", 90, "y"));

        FieldEdit edit = FieldEdit.endOfDomain("x", 50, known);

        assertThat(edit.written()).extracting(FieldVersion::id).containsExactly("moved", "now");
        assertThat(edit.removed()).containsExactly("planned" + LATER);
        assertThat(edit.ids()).containsExactly("moved", "now", "planned");
    }

    @Test
    void renamesAllVersionsAndNothingElse() throws Exception {
        List<FieldVersion> known = List.of(field("a", 10, "x"), FieldChange.end("a", 20), field("a", 90, "x"));

        List<FieldVersion> renamed = FieldEdit.rename("a", "Home", known).written();

        assertThat(renamed).extracting(FieldVersion::key).containsExactly("a@1970-01-01T00:00:00.010Z", "a" + LATER);
        assertThat(renamed).extracting(FieldVersion::name, FieldVersion::domain).containsOnly(tuple("Home", "x"));
        assertThat(FieldEdit.rename("a", "Home", renamed).written()).isEmpty();
    }

    private static org.assertj.core.groups.Tuple tuple(Object... values) {
        return org.assertj.core.groups.Tuple.tuple(values);
    }

    private static void refused(
            ErrorCode code, String reason, org.assertj.core.api.ThrowableAssert.ThrowingCallable edit) {
        assertThatThrownBy(edit)
                .isInstanceOfSatisfying(
                        RejectedException.class, e -> assertThat(e.code()).isEqualTo(code))
                .hasMessageContaining(reason);
    }

    private static FieldVersion field(String id, long validFrom, String domain) {
        ObjectNode properties =
                JsonNodeFactory.instance.objectNode().put("name", id).put("Domain", domain);
        return new FieldVersion(
                id, validFrom, JsonNodeFactory.instance.objectNode().put("type", "Polygon"), properties);
    }
}
