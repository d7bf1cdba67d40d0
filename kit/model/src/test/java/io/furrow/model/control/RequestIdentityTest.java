package io.furrow.model.control;

import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** Tests fingerprints and summaries of requests. */
class RequestIdentityTest {
    @Test
    void ignoresTheRequestIdAndTheOrderOfMembers() {
        String one = fingerprint("{'type':'request','requestId':'r-1','mission':'m','devices':[{'a':1,'b':2}]}");
        assertThat(one).matches("[0-9a-f]{32}");
        assertThat(fingerprint("{'devices':[{'b':2,'a':1}],'mission':'m','requestId':'r-2','type':'request'}"))
                .isEqualTo(one);
        for (String other : new String[] {
            "{'type':'request','mission':'n','devices':[{'a':1,'b':2}]}",
            "{'type':'request','mission':'m','devices':[{'a':1,'b':3}]}",
            "{'type':'request','mission':'m','devices':[{'a':1,'b':2}],'user':'ann'}",
            "{'type':'request','mission':'m','devices':[{'a':1},{'b':2}]}"
        }) {
            assertThat(fingerprint(other)).as(other).isNotEqualTo(one);
        }
    }

    @Test
    void computesTheFingerprintOfInvalidUnicode() {
        assertThat(fingerprint("{'mission':'\\ud800'}")).hasSize(32);
        assertThat(fingerprint("{'mission':")).isEmpty();
        assertThat(fingerprint("[]")).isEmpty();
    }

    @Test
    void readsTheSummaryOfAnUnreadRequest() {
        RequestSummary excerpt = excerpt("{'devices':[{'mission':'other'},['x']],'type':'request','mission':'m',"
                + "'requestId':'r-1','description':'" + "x".repeat(9000) + "','domain':7,'command':'start'");
        assertThat(excerpt.json())
                .hasToString("{'type':'request','mission':'m','requestId':'r-1','command':'start'}".replace('\'', '"'));
        assertThat(excerpt.requestId()).isEqualTo("r-1");
        assertThat(excerpt.isResponse()).isFalse();
        assertThat(excerpt.refusal(ErrorCode.TOO_LARGE, "too much").json())
                .hasToString(
                        "{'type':'response','status':'error','error':'too-large','reason':'too much','mission':'m'}"
                                .replace('\'', '"'));
        assertThat(excerpt("{'requestId':'a b'}").requestId()).isNull();
        assertThat(excerpt("{'type':'response'}").isResponse()).isTrue();
        assertThat(excerpt("nonsense").json()).isEmpty();
        assertThat(excerpt("[{'requestId':'r'}]").json()).isEmpty();
    }

    @Test
    void truncatesLongReasons() {
        assertThat(Limits.reason(null)).isNull();
        assertThat(Limits.reason("away")).isEqualTo("away");
        assertThat(Limits.reason("\ud800x")).isEqualTo("\ufffdx");
        String cut = Limits.reason("𝄞".repeat(600));
        assertThat(cut.codePointCount(0, cut.length())).isEqualTo(Limits.REASON_LENGTH);
        assertThat(UTF_8.newEncoder().canEncode(cut)).isTrue();
    }

    private static String fingerprint(String json) {
        return RequestFingerprint.of(bytes(json));
    }

    private static RequestSummary excerpt(String json) {
        return RequestSummary.of(bytes(json));
    }

    private static byte[] bytes(String json) {
        return json.replace('\'', '"').getBytes(UTF_8);
    }
}
