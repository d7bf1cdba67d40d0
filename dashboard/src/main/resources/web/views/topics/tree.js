/** Arranges topics by use: all reports, results, domains with their missions, replays, control topics, others. */
import { nameFromTopic } from '../../core/identities.js';
import { store } from '../../core/store.js';

const RESULTS = ['data.clocks', 'data.images', 'data.context', 'data.catalog'];
/** Shown even if the topic does not exist yet. */
const ALWAYS = 'data.collision';
const CANARY = 'canary';
const EVERYTHING = ['data.raw', 'data.latest', 'ngsi.notifications'];

/**
 * Arranges topics.
 *
 * @param {{name: string}[]} topics
 * @param {Iterable<string>} domains of the managers, with or without a topic
 * @param {Iterable<{mission: string, domain: string}>} missions
 * @returns {{all: string[], results: string[], domains: {domain: string, topic: string|null, missions: {mission: string, topic: string|null}[]}[],
 *     replays: string[], service: string[], other: string[], absent: string[]}} `absent` are results whose topics do not exist yet
 */
export function arrange(topics, domains, missions) {
  const names = new Set(topics.map((each) => each.name));
  const claimed = new Set();
  const claim = (list) => list.filter((name) => (names.has(name) || name === ALWAYS) && claimed.add(name));
  const tree = { all: claim(EVERYTHING), results: claim([...store.config.analytics.map((job) => `data.${job}`), ...RESULTS]), domains: domainsOf(names, domains, missions, claimed), replays: [], service: [], other: [], absent: [ALWAYS].filter((name) => !names.has(name)) };
  for (const name of names) {
    if (claimed.has(name)) {
      continue;
    }
    const place = /^data\..+\.replay\.[0-9a-f]{8}/.test(name) ? tree.replays : name.startsWith('service.') ? tree.service : tree.other;
    place.push(name);
  }
  return tree;
}

function domainsOf(names, domains, missions, claimed) {
  const byName = new Map();
  const of = (domain) => {
    if (!byName.has(domain)) {
      byName.set(domain, { domain, topic: null, missions: [] });
    }
    return byName.get(domain);
  };
  [...domains, CANARY].forEach(of);
  const keyOf = (domain, mission) => [domain, mission].map(nameFromTopic).join('\n');
  const missing = new Map([...missions].map((each) => [keyOf(each.domain, each.mission), each]));
  for (const name of names) {
    const [, domain, mission] = /^data\.([^.]+)\.realtime(?:\.([^.]+))?$/.exec(name) ?? [];
    if (domain) {
      claimed.add(name);
      mission ? of(domain).missions.push({ mission, topic: name }) : (of(domain).topic = name);
      mission && missing.delete(keyOf(domain, mission));
    }
  }
  // a mission without reports has no topic yet
  missing.forEach((each) => of(each.domain).missions.push({ mission: each.mission, topic: null }));
  const ordered = [...byName.values()].sort((a, b) => (a.domain === CANARY) - (b.domain === CANARY) || (a.domain < b.domain ? -1 : 1));
  ordered.forEach((each) => each.missions.sort((a, b) => (a.mission < b.mission ? -1 : 1)));
  return ordered;
}
