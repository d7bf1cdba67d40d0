package io.furrow.connect.ledger;

import java.lang.management.ManagementFactory;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.regex.Pattern;
import javax.management.Attribute;
import javax.management.AttributeList;
import javax.management.AttributeNotFoundException;
import javax.management.DynamicMBean;
import javax.management.InstanceAlreadyExistsException;
import javax.management.InstanceNotFoundException;
import javax.management.JMException;
import javax.management.MBeanAttributeInfo;
import javax.management.MBeanInfo;
import javax.management.MBeanServer;
import javax.management.ObjectName;

/**
 * Registers the metrics of a task in JMX until it is closed: {@code furrow.connect:type=ngsi-source,connector=…,task=0}, or
 * {@code type=ngsi-sink}, with the attributes {@code received-total} and so on, gauges without {@code -total}.
 */
public final class LedgerBean implements AutoCloseable {
    private static final Pattern NEEDS_NO_QUOTES = Pattern.compile("[\\w-%. ]+");

    private static final Map<ObjectName, LedgerBean> SHOWN = new HashMap<>();

    private final MBeanServer server = ManagementFactory.getPlatformMBeanServer();
    private final ObjectName name;

    private LedgerBean(ObjectName name) {
        this.name = name;
    }

    /** Registers the metrics of a task and replaces those left under the same name. */
    public static LedgerBean show(Metrics metrics, String type, String connector, int task) {
        return show(metrics, "type=" + type + ",connector=" + quoted(connector) + ",task=" + task);
    }

    /** Registers the metrics that the tasks of a connector share and replaces those left under the same name. */
    public static LedgerBean show(Metrics metrics, String type, String connector) {
        return show(metrics, "type=" + type + ",connector=" + quoted(connector));
    }

    private static String quoted(String connector) {
        return NEEDS_NO_QUOTES.matcher(connector).matches() ? connector : ObjectName.quote(connector);
    }

    private static LedgerBean show(Metrics metrics, String properties) {
        try {
            LedgerBean bean = new LedgerBean(new ObjectName("furrow.connect:" + properties));
            synchronized (SHOWN) {
                bean.unregister();
                bean.server.registerMBean(new Shown(metrics), bean.name);
                SHOWN.put(bean.name, bean);
            }
            return bean;
        } catch (InstanceAlreadyExistsException e) {
            throw new IllegalStateException("two tasks register the same name in JMX", e);
        } catch (JMException e) {
            throw new IllegalStateException("cannot register " + properties + " in JMX", e);
        }
    }

    /** Unregisters the bean; does nothing if it is not registered, or was replaced. */
    @Override
    public void close() {
        synchronized (SHOWN) {
            if (SHOWN.remove(name, this)) {
                unregister();
            }
        }
    }

    private void unregister() {
        try {
            server.unregisterMBean(name);
        } catch (InstanceNotFoundException e) {
            return; // it is not registered
        } catch (JMException e) {
            throw new IllegalStateException("cannot unregister " + name + " from JMX", e);
        }
    }

    /** Exposes all metrics as read-only attributes, without operations. */
    private record Shown(Metrics metrics) implements DynamicMBean {
        private static String attribute(Metric metric) {
            return metric.name('-') + (metric.isCounter() ? "-total" : "");
        }

        @Override
        public Object getAttribute(String attribute) throws AttributeNotFoundException {
            return metrics.all().stream()
                    .filter(metric -> attribute(metric).equals(attribute))
                    .findFirst()
                    .orElseThrow(() -> new AttributeNotFoundException(attribute))
                    .now();
        }

        @Override
        public AttributeList getAttributes(String[] names) {
            Set<String> requested = Set.copyOf(List.of(names));
            AttributeList found = new AttributeList();
            metrics.all().stream()
                    .filter(metric -> requested.contains(attribute(metric)))
                    .forEach(metric -> found.add(new Attribute(attribute(metric), metric.now())));
            return found;
        }

        @Override
        public MBeanInfo getMBeanInfo() {
            MBeanAttributeInfo[] attributes = metrics.all().stream()
                    .map(metric -> new MBeanAttributeInfo(
                            attribute(metric), Long.class.getName(), metric.help(), true, false, false))
                    .toArray(MBeanAttributeInfo[]::new);
            return new MBeanInfo(
                    metrics.getClass().getName(), "Metrics of a task since its start.", attributes, null, null, null);
        }

        @Override
        public void setAttribute(Attribute attribute) throws AttributeNotFoundException {
            throw new AttributeNotFoundException(attribute.getName() + " cannot be set");
        }

        @Override
        public AttributeList setAttributes(AttributeList attributes) {
            return new AttributeList();
        }

        @Override
        public Object invoke(String action, Object[] parameters, String[] signature) {
            throw new UnsupportedOperationException(action);
        }
    }
}
