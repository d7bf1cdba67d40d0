package io.furrow.connect.ledger;

import java.lang.management.ManagementFactory;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.LongSupplier;
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
 * The numbers of a task over JMX, while it is open: {@code furrow.connect:type=ngsi-source,connector=…,task=0}, or
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

    /** Shows a source's ledger, in the place of one that was left under the same name. */
    public static LedgerBean show(Ledger ledger, String connector, int task) {
        return show(ledger, "ngsi-source", connector, task);
    }

    /** Shows the numbers of a task of this type, in the place of those that were left under the same name. */
    public static LedgerBean show(Numbers numbers, String type, String connector, int task) {
        return show(numbers, "type=" + type + ",connector=" + quoted(connector) + ",task=" + task);
    }

    /** Shows the numbers that the tasks of a connector share, in the place of those that were left under the same name. */
    public static LedgerBean show(Numbers numbers, String type, String connector) {
        return show(numbers, "type=" + type + ",connector=" + quoted(connector));
    }

    private static String quoted(String connector) {
        return NEEDS_NO_QUOTES.matcher(connector).matches() ? connector : ObjectName.quote(connector);
    }

    private static LedgerBean show(Numbers numbers, String properties) {
        try {
            LedgerBean bean = new LedgerBean(new ObjectName("furrow.connect:" + properties));
            synchronized (SHOWN) {
                bean.unregister();
                bean.server.registerMBean(new Shown(numbers), bean.name);
                SHOWN.put(bean.name, bean);
            }
            return bean;
        } catch (InstanceAlreadyExistsException e) {
            throw new IllegalStateException("two tasks show themselves under one name at the same moment", e);
        } catch (JMException e) {
            throw new IllegalStateException("cannot show " + properties + " over JMX", e);
        }
    }

    /** Shows it no more; does nothing if it is not shown, or another one in its place. */
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
            return; // it is not shown
        } catch (JMException e) {
            throw new IllegalStateException("cannot take " + name + " from JMX", e);
        }
    }

    /** All as attributes to read; nothing to set, nothing to call. */
    private record Shown(Numbers of) implements DynamicMBean {
        private static final String DESCRIPTION = "What a task has counted since its start.";

        @Override
        public Object getAttribute(String attribute) throws AttributeNotFoundException {
            LongSupplier number = all().get(attribute);
            if (number == null) {
                throw new AttributeNotFoundException(attribute);
            }
            return number.getAsLong();
        }

        @Override
        public AttributeList getAttributes(String[] names) {
            Map<String, LongSupplier> numbers = all();
            AttributeList found = new AttributeList();
            for (String name : names) {
                if (numbers.containsKey(name)) {
                    found.add(new Attribute(name, numbers.get(name).getAsLong()));
                }
            }
            return found;
        }

        private Map<String, LongSupplier> all() {
            Map<String, LongSupplier> numbers = new TreeMap<>();
            of.counters().forEach(counter -> numbers.put(kebabCase(counter.name()) + "-total", counter::sum));
            of.gauges().forEach(gauge -> numbers.put(kebabCase(gauge.name()), gauge.now()));
            return numbers;
        }

        @Override
        public MBeanInfo getMBeanInfo() {
            List<MBeanAttributeInfo> attributes = new ArrayList<>();
            of.counters()
                    .forEach(counter -> attributes.add(readable(kebabCase(counter.name()) + "-total", counter.help())));
            of.gauges().forEach(gauge -> attributes.add(readable(kebabCase(gauge.name()), gauge.help())));
            MBeanAttributeInfo[] all = attributes.toArray(MBeanAttributeInfo[]::new);
            return new MBeanInfo(Ledger.class.getName(), DESCRIPTION, all, null, null, null);
        }

        private static MBeanAttributeInfo readable(String name, String help) {
            return new MBeanAttributeInfo(name, Long.class.getName(), help, true, false, false);
        }

        private static String kebabCase(String camelCase) {
            return camelCase.replaceAll("([A-Z])", "-$1").toLowerCase(Locale.ROOT);
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
