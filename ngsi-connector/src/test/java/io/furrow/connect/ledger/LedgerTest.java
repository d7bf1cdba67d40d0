package io.furrow.connect.ledger;

import java.lang.management.ManagementFactory;
import javax.management.AttributeNotFoundException;
import javax.management.InstanceNotFoundException;
import javax.management.MBeanServer;
import javax.management.ObjectName;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class LedgerTest {
    private final Ledger ledger = new Ledger();
    private final MBeanServer beans = ManagementFactory.getPlatformMBeanServer();

    @Test
    void showsEveryNumberAsJson() {
        ledger.received.add(3);
        ledger.gauge("pending", "Records that wait", () -> 7);
        ledger.detail("journal", () -> JsonNodeFactory.instance.textNode("j1"));

        assertThat(ledger.toJson().toString())
                .contains("\"received\":3", "\"rejectedUnavailable\":0", "\"pending\":7", "\"journal\":\"j1\"");
    }

    @Test
    void showsEveryNumberToPrometheus() {
        ledger.rejectedUnavailable.add(3);
        ledger.gauge("pendingBytes", "Bytes that wait", () -> 7);

        String page = new String(new PrometheusPage(ledger, "a \"b\"", 2).write(), UTF_8);

        assertThat(page)
                .contains("# TYPE furrow_ngsi_source_rejected_unavailable_total counter\n")
                .contains("# HELP furrow_ngsi_source_rejected_unavailable_total Accepted and dead records")
                .contains("furrow_ngsi_source_rejected_unavailable_total{connector=\"a \\\"b\\\"\",task=\"2\"} 3.0\n")
                .contains("furrow_ngsi_source_pending_bytes{connector=\"a \\\"b\\\"\",task=\"2\"} 7.0\n");
        assertThat(page.lines().filter(line -> line.startsWith("# TYPE")))
                .hasSize(ledger.all().size());
    }

    @Test
    void showsEveryNumberOverJmxWhileItIsOpen() throws Exception {
        ledger.rejectedUnavailable.add(3);
        ledger.gauge("pendingBytes", "Bytes that wait", () -> 7);
        ObjectName name = new ObjectName("furrow.connect:type=ngsi-source,connector=farm,task=1");

        try (LedgerBean shown = LedgerBean.show(ledger, "ngsi-source", "farm", 1)) {
            assertThat(shown).isNotNull();
            assertThat(beans.getAttribute(name, "rejected-unavailable-total")).isEqualTo(3L);
            assertThat(beans.getAttribute(name, "pending-bytes")).isEqualTo(7L);
            assertThat(beans.getMBeanInfo(name).getAttributes())
                    .hasSize(ledger.all().size());
            assertThatThrownBy(() -> beans.getAttribute(name, "nothing"))
                    .isInstanceOf(AttributeNotFoundException.class);
        }

        assertThatThrownBy(() -> beans.getAttribute(name, "rejected-unavailable-total"))
                .isInstanceOf(InstanceNotFoundException.class);
    }

    @Test
    void takesThePlaceOfOneThatWasLeft() throws Exception {
        Ledger left = new Ledger();
        ObjectName name = new ObjectName("furrow.connect:type=ngsi-source,connector=\"x,y=z\",task=0");
        ledger.received.add(9);

        LedgerBean old = LedgerBean.show(left, "ngsi-source", "x,y=z", 0);
        LedgerBean shown = LedgerBean.show(ledger, "ngsi-source", "x,y=z", 0);

        assertThat(beans.getAttribute(name, "received-total")).isEqualTo(9L);
        old.close();
        assertThat(beans.getAttribute(name, "received-total"))
                .as("it is not the old one's any more")
                .isEqualTo(9L);
        shown.close();
        assertThat(beans.isRegistered(name)).isFalse();
    }
}
