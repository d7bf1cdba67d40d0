package io.furrow.soak.source;

import java.io.IOException;
import java.util.OptionalLong;
import javax.management.JMException;
import javax.management.MBeanServerConnection;
import javax.management.ObjectName;
import javax.management.remote.JMXConnector;
import javax.management.remote.JMXConnectorFactory;
import javax.management.remote.JMXServiceURL;

/** What a worker shows of the source over JMX. */
record WorkerGauges(int jmxPort) {
    /** One look; zeros where nothing of the source is shown, empty tasks where nobody answers. */
    record Shown(
            int tasks, long pending, long adopted, long orphaned, long recovered, long leftRecords, long leftJournals) {
        static final Shown NOTHING = new Shown(0, 0, 0, 0, 0, 0, 0);

        /** Records that are said to be on this disk and not in Kafka. */
        long onDisk() {
            return pending + leftRecords;
        }

        @Override
        public String toString() {
            return String.format(
                    "tasks %d, pending %d, adoptedJournals %d, orphanedJournals %d, left-records %d, left-journals %d",
                    tasks, pending, adopted, orphaned, leftRecords, leftJournals);
        }
    }

    Shown read() {
        String url = "service:jmx:rmi:///jndi/rmi://127.0.0.1:" + jmxPort + "/jmxrmi";
        try (JMXConnector connector = JMXConnectorFactory.connect(new JMXServiceURL(url))) {
            MBeanServerConnection beans = connector.getMBeanServerConnection();
            ObjectName tasks = new ObjectName("furrow.connect:type=ngsi-source,*");
            ObjectName left = new ObjectName("furrow.connect:type=ngsi-source-left,*");
            return new Shown(
                    beans.queryNames(tasks, null).size(),
                    sum(beans, tasks, "pending"),
                    sum(beans, tasks, "adopted-journals"),
                    max(beans, tasks, "orphaned-journals"),
                    sum(beans, tasks, "recovered-total"),
                    sum(beans, left, "left-records"),
                    sum(beans, left, "left-journals"));
        } catch (IOException | JMException e) {
            return Shown.NOTHING;
        }
    }

    private static long sum(MBeanServerConnection beans, ObjectName names, String attribute)
            throws IOException, JMException {
        long sum = 0;
        for (ObjectName name : beans.queryNames(names, null)) {
            sum += (Long) beans.getAttribute(name, attribute);
        }
        return sum;
    }

    /** All tasks of a worker see the same folder. */
    private static long max(MBeanServerConnection beans, ObjectName names, String attribute)
            throws IOException, JMException {
        OptionalLong max = OptionalLong.empty();
        for (ObjectName name : beans.queryNames(names, null)) {
            max = OptionalLong.of(Math.max(max.orElse(0), (Long) beans.getAttribute(name, attribute)));
        }
        return max.orElse(0);
    }
}
