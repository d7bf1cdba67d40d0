package io.furrow.flink.record;

import java.io.Serializable;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Function;

import org.apache.flink.api.common.functions.RuntimeContext;
import org.apache.flink.api.common.state.MapState;
import org.apache.flink.api.common.state.MapStateDescriptor;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeinfo.Types;

/**
 * Keyed state of the entities that share an id, by their type. Nearly always there is one: it is a separate value, the others
 * are in a map.
 *
 * @param <T> the state of an entity
 */
public final class ByType<T> {
    private final ValueState<T> first;
    private final MapState<String, T> others;
    private final Function<T, String> typeOf;

    /** The name and type of the state, and how to find the entity's type. */
    public record Descriptor<T>(String name, Class<T> type, TypeOf<T> typeOf) {
        public ByType<T> of(RuntimeContext context) {
            TypeInformation<T> information = TypeInformation.of(type);
            return new ByType<>(
                    context.getState(new ValueStateDescriptor<>(name, information)),
                    context.getMapState(new MapStateDescriptor<>(name + "-of-other-types", Types.STRING, information)),
                    typeOf);
        }
    }

    /** Returns the entity type of a state; empty for a deletion without one. */
    public interface TypeOf<T> extends Function<T, String>, Serializable {}

    private ByType(ValueState<T> first, MapState<String, T> others, Function<T, String> typeOf) {
        this.first = first;
        this.others = others;
        this.typeOf = typeOf;
    }

    /** Null if there is none. */
    public T get(String type) throws Exception {
        T one = first.value();
        return one != null && is(one, type) ? one : others.get(type);
    }

    /** The state of one type, or of all if the type is empty. */
    public List<T> allOf(String type) throws Exception {
        if (!type.isEmpty()) {
            T one = get(type);
            return one == null ? List.of() : List.of(one);
        }
        List<T> all = new ArrayList<>();
        if (first.value() != null) {
            all.add(first.value());
        }
        others.values().forEach(all::add);
        return all;
    }

    public boolean isEmpty() throws Exception {
        return first.value() == null && others.isEmpty();
    }

    /** Null if there is none. */
    public T first() throws Exception {
        return first.value();
    }

    /** @return whether it is not the first of its id */
    public boolean put(String type, T known) throws Exception {
        T one = first.value();
        boolean isOther = one == null ? others.contains(type) : !is(one, type);
        put(!isOther, known);
        return isOther;
    }

    /** As {@link #put} if the caller knows whether it is the first. */
    public void put(boolean isFirst, T known) throws Exception {
        if (isFirst) {
            first.update(known);
        } else {
            others.put(typeOf.apply(known), known);
        }
    }

    public void remove(T known) throws Exception {
        if (known.equals(first.value())) {
            first.clear();
        } else {
            others.remove(typeOf.apply(known));
        }
    }

    private boolean is(T known, String type) {
        String its = typeOf.apply(known);
        return its.isEmpty() || its.equals(type);
    }
}
