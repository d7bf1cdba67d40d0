package io.furrow.soak.source;

import java.io.IOException;
import java.util.OptionalLong;
import javax.management.JMException;
import javax.management.MBeanServerConnection;
import javax.management.ObjectName;
import javax.management.remote.JMXConnector;
import javax.management.remote.JMXConnectorFactory;
import javax.management.remote.JMXServiceURL;

/** Reads a worker's gauges of the source over JMX. */
record WorkerGauges(int jmxPort) {
    /** The gauges at a moment; zeros without a source, and zero tasks if the worker does not respond. */
    record Shown(
            int tasks, long pending, long adopted, long orphaned, long recovered, long leftRecords, long leftJournals) {
        static final Shown EMPTY = new Shown(0, 0, 0, 0, 0, 0, 0);

        /** The number of records on the disk that are not in Kafka. */
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
            return Shown.EMPTY;
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

    /** The maximum, since all tasks of a worker read the same folder. */
    private static long max(MBeanServerConnection beans, ObjectName names, String attribute)
            throws IOException, JMException {
        OptionalLong max = OptionalLong.empty();
        for (ObjectName name : beans.queryNames(names, null)) {
            max = OptionalLong.of(Math.max(max.orElse(0), (Long) beans.getAttribute(name, attribute)));
        }
        return max.orElse(0);
    }
}
