/** All texts of the page, in English: `t('section.name', {count: 3})`. Another language has the same names in `texts.<language>.js`. */
import { language } from './core/language.js';

const english = {
  app: {
    title: 'Furrow',
    skip: 'Skip to content', skipPanel: 'Skip to alarms and devices', skipTimeline: 'Skip to timeline',
    find: 'Find a device, field or alarm', findShort: 'Find …',
    live: 'Live', notConnected: 'Not connected',
    replayOf: 'Replay of {mission} · {day}',
    toLive: 'Back to live',
    liveView: 'This view is live. The map shows a replay of {mission}.', toReplay: 'To the replay',
    scope: 'What is shown', others: '{count} outside of {scope}: show all', only: 'Only {scope}.',
    alarms: '{count open alarm|open alarms}',
    places: 'Places',
    settings: 'Settings',
    signOut: 'Sign out',
    scheme: 'Appearance',
    schemes: { system: 'Same as the system', dark: 'Dark', light: 'Light', sunlight: 'Sunlight, high contrast' },
    language: 'Language',
    allDomains: 'All domains',
    viewFailed: 'This part of the page could not be loaded: {reason}. Reload the page; if the problem persists, check the dashboard’s log.',
    lost: 'Not connected for {duration}, trying again. The data shown is from {time}.',
    lostNever: 'Not connected for {duration}, trying again. {reason}',
    away: 'The connection was lost from {from} to {to}.',
    gap: '{count record|records} missed.',
    panel: 'Alarms and devices',
    timeline: 'Timeline',
    csv: 'Save as CSV', csvOf: 'Save as CSV: {table}',
    enteredReplay: 'Showing the replay of {mission}. Commands are not sent.',
    enteredLive: 'Showing live data.',
  },

  views: { map: 'Map', missions: 'Missions', replays: 'Replays', analyses: 'Analyses', history: 'History', topics: 'Topics', platform: 'Platform', report: 'Report' },

  signIn: {
    title: 'Sign in',
    token: 'Access token',
    hint: 'Ask the operator of the control plane for a token.',
    submit: 'Sign in',
    wrong: 'The control plane does not know this token.',
    notByProxy: 'The proxy has not signed you in. Ask the operator of the proxy for the reason.',
    byProxy: 'Sign in again', or: 'or with an access token', submitToken: 'Use the token',
  },

  opening: {
    away: 'The farm cannot be shown yet: {reason}',
    again: 'Retrying automatically.',
    retry: 'Try now',
  },

  units: {
    second: 's', minute: 'min', hour: 'h', day: 'd', meter: 'm', kilometer: 'km', hectare: 'ha', millimeter: 'mm', meterPerSecond: 'm/s', kilometerPerHour: 'km/h',
    celsius: '°C', percent: '%', degree: '°', hectopascal: 'hPa', lux: 'lx', volt: 'V', ampere: 'A', watt: 'W', wattPerSquareMeter: 'W/m²',
    byte: 'B', kilobyte: 'kB', megabyte: 'MB', gigabyte: 'GB', terabyte: 'TB',
  },

  format: { ago: '{duration} ago', yes: 'yes', no: 'no', time: 'YYYY-MM-DD HH:MM:SS' },

  errors: {
    noAnswer: 'The server does not answer. Check that ./furrow dashboard runs and that this machine reaches it.',
    status: 'The server rejected the request with status {status}.',
  },

  kinds: { robot: 'robot', sensor: 'sensor', camera: 'camera', other: 'device' },
  states: { ok: 'reporting', attention: 'needs a look', stale: 'silent', off: 'off' },

  // ------------------------------------------------------------------------------------------------------------------

  map: {
    label: 'Map of the farm. Arrow keys move it, plus and minus zoom; the table has the same in rows.',
    controls: 'Map', zoomIn: 'Zoom in', zoomOut: 'Zoom out', fit: 'Show the whole farm', farms: 'Farms', layers: 'What is shown', table: 'The map as a table', closeTable: 'Close the table',
    tables: { devices: 'Devices', encounters: 'Encounters', fields: 'Fields', coverages: 'Worked area' },
    cells: { worked: 'worked', 'worked-again': 'worked again', gap: 'gap' }, toggleCells: 'Show or hide what was worked', workedShare: '{share} worked',
    base: { title: 'Base map', none: 'none', server: 'of the server', address: 'of {host}', file: 'Choose a PMTiles file …', hint: 'Pictures of tiles; the file is stored in this browser and works offline. Tiles of a server are shown if --tiles of ./furrow dashboard, up or demo names it: this page may load pictures of no other.', remove: 'Remove {file} from this browser', noPictures: '{file} has no pictures as tiles', failed: 'The base map cannot be shown: {reason}' },
    options: { trails: 'Trails', labels: 'Names', rows: 'Rows of fields' },
    legend: 'Legend', stopped: 'off or stopped', encounter: 'encounter', predicted: '{distance} in {time} s', apart: 'now {now}, closest {closest}', ended: 'came within {closest}', closest: 'closest {distance}',
    devices: '{count device|devices}', unverified: 'unverified', suspects: '{count} suspect', noAlarms: 'no alarms',
    cluster: '{count} devices, click to open', oneSpot: '{count} devices in one spot',
    columns: { name: 'Name', kind: 'Kind', state: 'State', latitude: 'Latitude', longitude: 'Longitude', position: 'Position', speed: 'Speed', age: 'Heard', pair: 'Devices', phase: 'Phase', distance: 'Distance', closest: 'Closest', field: 'Field', average: 'Average', devices: 'Devices', suspects: 'Suspects', mission: 'Mission', hectares: 'Worked', share: 'Share', overlap: 'Again', gaps: 'Gaps', left: 'Time left' },
    speed: '{speed} m/s',
    phases: { predicted: 'predicted', started: 'too close', ongoing: 'too close', ended: 'over', crossed: 'crossed' },
    faults: { 'no-number': 'no number', 'no-point': 'no point', 'out-of-range': 'outside the map', 'no-fix': 'no fix' },
    moreRows: 'and {count} more; search to find them',
    emptyTitle: 'No devices yet', emptyText: 'Devices appear here when they report. To start simulated ones:',
  },

  // ------------------------------------------------------------------------------------------------------------------

  draw: {
    title: 'Draw fields', open: 'Draw and change fields', field: 'New field', zone: 'New zone', type: 'Type corners', changeField: 'Change a field …', done: 'Done', save: 'Save', finish: 'Finish', removeLast: 'Remove last corner',
    attributes: 'Attributes and corners', attributesOf: 'Attributes of {field}', newField: 'New field', newZone: 'New zone without alarms', chooseHint: 'Click a field to change it, or draw a new one.', drawHint: 'Click each corner; click the first one again to finish. Backspace removes the last corner.', shapeHint: 'Drag corners, drag a side to add one, drag the inside to move the whole. Alt and a click removes a corner.',
    crop: 'Crop', rowDirection: 'Direction of rows', rowDirectionHint: 'Degrees clockwise from north. Empty: no rows are drawn.', alongSide: 'Along the longest side', noDomain: 'none', zoneHint: 'Devices in a zone raise no encounters. The job that finds encounters reads zones when it starts.', corners: 'Corners', cornersLabel: 'Latitude and longitude of each corner', cornersHint: 'One corner per line, in degrees. An empty line is between the border and a hole.', noCorner: 'Line {line} is no corner. Write latitude and longitude in degrees, for example 40.3123456, -3.4823456.', rings: 'The outline has {count ring|rings}. Separate them by empty lines, and no corners of one ring.',
    faults: {
      crosses: 'The border crosses itself at {place}. Move a corner so that it does not.', corners: 'A field needs at least three corners. Add some.',
      outside: 'A corner is outside of the map: latitudes are between −85.05 and 85.05, longitudes between −180 and 180.', many: 'The outline has more than 5000 corners. Import it from a file.',
    },
    drawn: '{field} was drawn', renamed: '{field} was renamed', deleted: '{field} was deleted', moved: '{field} was moved', changed: '{field} was changed', ended: '{field} was ended', saved: '{field} is saved.', undo: 'Undo: {change}', undone: 'Undone: {change}.', undoAnyway: 'Undo both',
    changedSince: 'The field was changed again since, here or by somebody else. Undoing takes back that change too.', conflict: 'Somebody changed {field} meanwhile. Cancel, and change it as it is now.',
  },

  // ------------------------------------------------------------------------------------------------------------------

  cards: {
    title: 'Devices', silent: '{count device|devices} silent or off', count: '{count} · {reporting} reporting', found: '{found} of {count}', unknown: '{device} has never reported, or was deleted.', filter: 'Show only', loading: 'Devices are being read',
    state: 'State', fieldMean: 'Field mean', suspect: 'suspect', noPosition: 'no position', details: 'All attributes of {name}',
    line: '{label}: now {now} {unit}, between {min} and {max} {unit}',
    lineConstant: '{label}: {now} {unit} all the time',
    tooLarge: 'Too large to show', omitted: '{count more attribute is|more attributes are} not shown.',
    noPicture: 'No picture stored yet', pictureOf: 'Picture of {age}', pictureAlt: 'Newest picture of {name}', pictureFailed: 'No picture: {reason}',
    recorded: 'recorded, not sent', confirm: 'Send “{command}” to {name}?', refused: '{command} was not sent: {reason}',
    outcomes: { pending: '{command} sent {ago}, no answer yet', ok: '✓ {command}, {ago}', failed: '✗ {command} failed {ago}. {info}', unanswered: '{command}: no answer since {ago}' },
    connection: {
      report: 'Last report of {time}, received {offset} later.', ahead: 'Last report of {time}: its clock is {offset} ahead.',
      unregistered: 'The IoT Agent does not know it.', login: 'Connected to the MQTT broker at {time}.', noLogin: 'Has not connected to the MQTT broker since {time}.',
      password: 'Its password was refused {times} {time}.', user: 'Its user {user} does not exist or no longer, and was refused {times} {time}.',
      foreign: 'Published {times} {time} to {topic}, where it may not.', once: 'once, at', times: '{count} times, last at', unreadable: '{count} of its messages could not be read, the last at {time}: {reason}. It began with {payload}',
    },
    none: 'No devices yet', noneHint: 'The card of a device appears here when it reports.',
    noneYet: 'Nothing yet at this moment', noneYetHint: 'The replay has no report yet, or none at all.',
    noMatch: 'No device matches', noMatchHint: 'Clear the search or the chips above to see all devices.',
  },

  stopAll: {
    title: 'Stop all robots', short: 'Stop all', again: 'Stop the others again', none: 'No robot that can be stopped is known.',
    text: 'Sends Stop to each robot of all domains, whatever is searched or chosen; robots of stopped missions are off already.',
  },

  // ------------------------------------------------------------------------------------------------------------------

  alarms: {
    apart: '{first} and {second} are {now} apart, closest {closest}', within: '{first} and {second} came within {closest}',
    title: 'Alarms', reading: 'Alarms are being read …', failed: 'The alarms cannot be read: {reason}', open: '{count} open', none: 'No open alarms', noMatch: 'No open alarm matches the search.', noneHere: 'No open alarm here.', quiet: '{count} acknowledged, muted or explained by another', liveInReplay: 'Live, not from the replay: {count alarm|alarms}', further: 'Show {count} more',
    acknowledge: 'Acknowledge', more: 'Mute or close', mute10: 'Mute for 10 minutes', mute60: 'Mute for an hour', mute480: 'Mute for 8 hours', unmute: 'Unmute', close: 'Close',
    seen: '{count} times', affected: '{count} of {total}', by: 'acknowledged by {user}', mutedUntil: 'muted until {time}', inhibited: 'explained by another alarm',
    announced: 'New alarm, {severity}: {text}', notify: 'Tell me when this page is in the background', notification: 'Furrow: {severity} alarm',
  },

  // ------------------------------------------------------------------------------------------------------------------

  topics: {
    hint: 'Tick a topic to see its records; the map sign shows only a domain or mission on the map.',
    sections: { results: 'Results', domains: 'Domains and missions', all: 'Everything reported', replays: 'Replays', service: 'Requests and states', other: 'Other topics' },
    rate: '{rate}/s', noneYet: 'no records yet', noDomains: 'There is no domain yet. Create one in the missions view.',
    showOnly: 'Show only {name} on the map', showAll: 'Show everything on the map again',
    records: 'Records', noneChosen: 'No topic chosen', noneChosenHint: 'Choose one or several; their records appear here, newest first.',
    columns: { time: 'Time', topic: 'Topic', key: 'Key', value: 'Value' },
    pause: 'Pause', goOn: 'Resume', paused: 'paused', findKey: 'Only keys with …', count: '{count} newest', quiet: 'no record since the topic was chosen', noMatch: 'no key matches', gaps: '{count} missed', waiting: 'trying to connect',
    open: 'Record of {time}', cut: 'too large to show: {size}', deleted: 'deleted', shortened: 'shortened, {size} in all', where: 'Partition {partition}, offset {offset}, key {key}', headers: 'Headers',
  },

  // ------------------------------------------------------------------------------------------------------------------

  credentials: {
    title: 'Logins of {mission}', hint: 'Real devices report over MQTT with these logins, which are valid until the mission is stopped. Anyone with a login can report as that device.', none: 'The mission has no real device with a login of Furrow.',
    download: 'Download as CSV ({count})', code: 'Login of {device} as a code for a camera', sends: 'It may send: {names}',
    facts: { host: 'Broker', port: 'Port', tls: 'TLS', user: 'User', password: 'Password', measures: 'Publishes to', commands: 'Subscribes to', results: 'Answers commands on' },
  },
  missions: {
    tabs: { missions: 'Missions', domains: 'Domains and fields', audit: 'Who commanded what' },
    new: 'New mission', create: 'Create', cancel: 'Cancel', name: 'Name', nameHint: '1 to 64 of A–Z a–z 0–9 _ -', domain: 'Domain', template: 'Template', chooseTemplate: 'Choose a template …', templateVersion: '{template}, version {version}',
    noTemplateList: 'The templates cannot be listed: {reason}', ownDevices: 'No template: devices of my own', ids: 'Devices that already have a login', ownHint: 'Entity ids, one per line. Empty if there are none.', type: 'Type', count: 'How many', period: 'One report every', simulated: 'Simulated', simulatedHint: 'Needs a host of simulated devices; a real device is up by its first report', moreDevices2: 'Devices of another type', lessDevices: 'Remove these devices', simulatedTemplate: 'Its devices are simulated', minutes: 'Length in minutes', minutesHint: 'Empty: until it is stopped', startNow: 'Start it at once',
    columns: { mission: 'Mission', domain: 'Domain', template: 'Template', state: 'State', since: 'Since', start: 'Started', devices: 'Devices', confirmed: 'In the desired state' },
    none: 'No missions yet', noneHint: 'A mission says which devices work where. Create one from a template.',
    states: { created: 'not started', starting: 'starting', running: 'running', stopping: 'stopping', stopped: 'stopped', failed: 'failed' },
    confirmed: '{confirmed} of {devices device|devices}', missing: '{count} missing', since: 'for {age}', notYet: 'not yet', progress: 'Devices in the desired state',
    startedAt: 'started {time}', lasts: 'for {duration}', left: '{duration} left', start: 'Start', stop: 'Stop', delete: 'Delete', replay: 'Replay', report: 'Report',
    credentials: 'Logins', startTitle: 'Start {mission}?', stopTitle: 'Stop {mission}?', stopText: 'Simulated devices are switched off; the logins of real ones end until it is started again. What it recorded stays.', deleteTitle: 'Delete {mission}?', deleteText: 'Its plan and its devices are deleted. What it recorded stays in MongoDB.',
    devices: 'Devices', deviceColumns: { device: 'Device', state: 'State', health: 'Health', battery: 'Battery', seen: 'Heard', audit: 'Commands' }, onMap: 'Show {device} on the map', auditOfDevice: 'Who commanded {device}',
    viewer: 'You can view everything. Commands require the role of an operator', noDevicesYet: 'Its devices are being created.', planned: '{count device|devices} planned, created when it starts.', moreDevices: 'and {count} more',
    check: 'Check of each device', unnamed: 'Device', levels: { ok: 'in order', unknown: 'not known', warning: 'needs a look', problem: 'in the way' },
    checkGood: '{count} of {count} in order', checkBad: '{bad} of {count} {bad: needs|need} a look', checkProblem: '{problems} of {count} {problems: is|are} in the way', checkProblemMore: '{problems} of {count} {problems: is|are} in the way, {bad} more {bad: needs|need} a look',
    findings: {
      made: '{count} registered when the mission starts, with a login each', simulated: '{count} simulated when the mission starts', neverSeen: 'has never reported, it may be unreachable', seen: 'heard {ago} ago', silent: 'silent for {ago}', off: 'switched off; the mission switches it on',
      noBattery: 'reports no battery', battery: 'battery {percent} %', batteryLow: 'battery low, {percent} %', used: 'runs in mission {mission}',
      noPosition: 'its position is not known', noFields: 'the domain has no field', noSuchField: 'there is no field {field}', inside: 'in {field}', outside: 'outside the fields of the domain',
    },
    audit: 'Who commanded what', noAudit: 'Nobody has commanded anything yet.', noAuditOf: 'Nobody has commanded anything of it.', noAuditYet: 'Nothing of it is among the newest commands.', showOlder: 'Show older', readingOlder: 'Reading older ones …', noOlder: 'There are no older ones.', auditOf: { mission: 'Mission', device: 'Device', all: 'all' }, auditColumns: { time: 'When', user: 'Who', command: 'Command', about: 'About', result: 'Result' },
    targets: { mission: 'mission', domain: 'domain', replay: 'replay', alarm: 'alarm', device: 'device', field: 'fields', marker: 'marker', other: 'other' }, refusedBecause: 'refused: {reason}',
    domains: 'Domains', newDomain: 'New domain', noDomains: 'No domains yet', noDomainsHint: 'A domain is a farm, or a part of one; missions and fields belong to it.', domainId: 'Name in topics', domainName: 'Name for people', description: 'Description',
    countMissions: '{count mission|missions}', countFields: '{count field|fields}', deleteDomain: 'Delete domain {domain}', deleteDomainEmpty: 'It has no missions and no fields.', deleteDomainText: 'Deletes {missions} with all devices, and ends {fields}. Recordings and results are kept.', deleteDomainForce: 'Stop what runs: {missions}',
    fields: 'Fields', noFields: 'No fields yet', noFieldsHint: 'Draw fields on the map, import their borders as GeoJSON, or drop a file here; averages and presence are computed for each.', fieldColumns: { field: 'Field', domain: 'Domain', kind: 'Kind', from: 'Since' },
    fieldActs: { rename: 'Rename {field}', end: 'End {field}', delete: 'Delete {field}' }, rename: 'Rename', renameHint: 'The id stays. The next import names it as its file does.', end: 'End', endAt: 'When', endHint: 'Empty: now',
    endText: 'From then on it has no averages and stays. Earlier results are kept, and a replay of an earlier time uses the field as it was.',
    deleteFieldText: 'All its versions are deleted. Undo writes them again until this page is closed. Stored results are kept. To keep its history, end it instead.',
    lostDomain: '{domain} does not exist', field: 'field', zone: 'zone without alarms', always: 'always', importFields: 'Import fields', import: 'Import', file: 'File', fileHint: 'GeoJSON with polygons, or a GeoPackage with one layer; at most 16 MiB. Shapefiles: ./furrow fields import.', asFeaturesSay: 'as given in each feature', close: 'Close',
    previewFields: 'Areas in the file: {count}', previewSome: 'Areas in the file: {areas}. Other features, which will be rejected: {others}', previewGeoPackage: 'A GeoPackage is read by the server.', tooLarge: 'The file has {size} MiB; at most 16 are accepted.', imported: 'Imported: {imported}. Unchanged: {unchanged}', feature: 'Feature {number} {id}', noGeoJson: 'The file is not a GeoJSON.', refusedFields: '{count} refused', mendedFields: '{count} repaired',
  },

  // ------------------------------------------------------------------------------------------------------------------

  replays: {
    title: 'Replays',
    lead: 'Play the reports of missions again: on the map, in the cards, and for analytics.',
    running: 'Running',
    recorded: 'Recorded missions',
    none: 'No missions are stored yet',
    noneHint: 'With MongoDB, all that a mission reports is stored from its start. Start one, and it is listed here half a minute later.',
    noneButton: 'To the missions',
    choose: 'Choose {mission}',
    choice: 'Mission', when: 'When', length: 'Length', devices: 'Devices', events: 'Events', density: 'Events over time',
    now: 'being recorded', wrongClock: 'More than a year: the clock of a device was wrong.',
    chooseOne: 'Choose one mission, or several to play them with one clock.',
    plan: 'New replay',
    planOf: 'Replay of {missions}',
    oneClock: 'With one clock, all show the same event time at any moment.',
    from: 'From ({zone})', to: 'To ({zone})', wrongRange: 'The end must be after the beginning.',
    at: 'At', speed: 'Speed', times: '{speed} ×', fastest: 'as fast as possible',
    analytics: 'With analytics', analyticsHint: 'Encounters, averages, presence and worked areas are computed again and shown with the replay.',
    loop: 'Repeat',
    skip: 'Shorten stretches without events to 30 s',
    start: 'Start replay', starting: 'Starting …',
    notPlayed: 'No job plays the replay. Check that the job replay runs: ./furrow replay list shows its state.',
    viewer: 'Viewers can watch running replays. Starting one requires the role of an operator.',
    noRunning: 'No replay runs',
    noRunningHint: 'Choose a mission below and start one.',
    watch: 'Watch', watching: 'Watched', stop: 'Stop', again: 'Play again',
    copyLink: 'Copy link to this moment', copied: 'Copied. The link leads to {time}.', copyFailed: 'The browser cannot copy the link: {link}',
    position: '{position} of {length} at {speed} ×', positionFast: '{position} of {length}, as fast as possible',
    states: { starting: 'starting', waiting: 'waiting', running: 'playing', paused: 'paused', ended: 'at its end', stopped: 'stopped', failed: 'failed', over: 'over' },
    link: 'A link to a moment of {missions}', linkHint: '{time}. That replay is over; it can be started there.', linkOver: '{time}. That replay is over.', linkStart: 'Start it there',
  },

  // ------------------------------------------------------------------------------------------------------------------

  timeline: {
    position: 'Play head',
    live: 'live', lost: 'not connected',
    play: 'Play', pause: 'Pause', playHint: 'Play or pause (space)',
    stepBack: 'Step back', stepBackHint: 'One event back (←); 10 s with shift',
    stepForward: 'Step forward', stepForwardHint: 'One event forward (→); 10 s with shift',
    speed: 'Speed', times: '{speed} ×', fastest: 'fastest',
    loop: 'Loop', loopHint: 'Repeat a part ([ and ] set its ends; drag along the times)',
    mark: 'Add a marker', markHint: 'Mark this moment with a note (m)',
    more: 'More controls',
    zoomIn: 'Zoom in', zoomInHint: 'Zoom in (wheel)', zoomOut: 'Zoom out', zoomOutHint: 'Zoom out (wheel)',
    encounters: '{count encounter|encounters}', markers: '{count marker|markers}',
    lastMinutes: 'last {minutes} min',
    lastSeconds: 'last {seconds} s',
    valueReplay: '{time}, {done} of {all}, {state}',
    valueLive: 'live',
    valueMoment: '{time}, chosen to replay from',
    replayMission: 'Replay {mission}',
    replayFrom: 'Replay from {time}', replayAny: 'Replay from {time} …',
    chooseReplay: 'Replays',
    startAgain: 'Start again',
    starting: 'The replay starts.',
    counting: 'counting events …',
    noDensity: 'Cannot show the events: {reason}',
    tipEncounter: '{pair} · closest {distance}',
    flag: 'Marker {note}, {time}',
    markTitle: 'Mark this moment', markDelete: 'Delete marker {note}', markNote: 'What happens here?', markSave: 'Add marker', cancel: 'Cancel',
  },

  // ------------------------------------------------------------------------------------------------------------------

  analyses: {
    title: 'Analyses',
    live: 'Live results of analytics.', replay: 'Results of analytics in the replay of {mission}.', noAnalytics: 'This replay was started without analytics. Showing the live results from the time of the recording.',
    period: 'Period', hours: 'last {hours} h', quarter: 'last 15 min', mission: 'whole mission',
    averages: 'Averages per field', encounters: 'Encounters', presence: 'Presence in fields',
    chart: 'Chart', table: 'Table',
    since: 'The topic has records since {time}; earlier ones have been deleted.',
    failed: 'This could not be read: {reason}', retry: 'Try again',
    noAverages: 'No averages in this period', noAveragesHint: 'Averages are computed per window from thermometers inside fields.',
    noEncounters: 'No encounters in this period', noEncountersHint: 'An encounter begins when two devices come closer than the threshold.',
    noPresence: 'No device was in a field in this period', noPresenceHint: 'A stay begins when a device enters a field.',
    window: 'Window', from: 'From', to: 'To', field: 'Field', mean: 'Average', plain: 'Plain mean', devices: 'Devices', suspects: 'Suspects', quality: 'Quality', none: 'none',
    qualities: { robust: 'robust', unverified: 'unverified' },
    suspectMark: 'Triangle: a device was suspect in this window', hide: 'Show or hide {field}',
    when: 'When', pair: 'Devices', closest: 'Closest', duration: 'Duration', phase: 'Phase', sort: 'Sort by {column}',
    phases: { started: 'ongoing', ongoing: 'ongoing', ended: 'ended', crossed: 'crossed' },
    toMoment: 'To the moment', toMomentOf: 'To the moment of {pair} at {time}',
    noRecording: 'not recorded', more: '{shown} of {count} are shown: show more',
    stay: '{device} in {field}, {from} to {to}', stillIn: 'still there', device: 'Device', entered: 'Entered', left: 'Left', stayed: 'Stayed',
    at: '{value} at {time}', chartLabel: 'Averages per field over time; the table has the same numbers',
  },

  // ------------------------------------------------------------------------------------------------------------------

  history: {
    title: 'History', of: 'History of {name}', live: 'What missions have recorded of a device.', replay: 'What was recorded of a device in mission {mission}.',
    device: 'Device', choose: 'Choose a device …', attribute: 'Attribute', second: 'Beside it', alone: 'nothing',
    hour: 'last hour', days: 'last {days} d', own: 'From … to', show: 'Show',
    threshold: 'Threshold', csv: 'CSV', png: 'PNG',
    chart: '{label} of {device} from {from} to {to}: lowest {min}, highest {max}, newest {now}; the table has the same numbers',
    noDevice: 'No device chosen', noDeviceHint: 'Choose one above, or the chart sign on its card.',
    noAttribute: 'No numbers or texts of this device', noAttributeHint: 'It reports none now. Choose another device.',
    none: 'No value in this period', noneHint: 'No mission has recorded one. A longer period may have some.',
    other: 'No number and no text', otherHint: 'Numbers, yes or no, and texts are shown here. The topics view shows values of other kinds.',
    since: 'Stored since {time}, or read no further back.', notStored: 'Nothing of this period is stored.', thinned: '{values} values; of each {part} the lowest and the highest are shown.', skipped: '{count value is|values are} left out: no numbers, or in another unit.',
    pictures: 'Pictures', allPictures: 'Pictures of all cameras', picture: 'Picture', pictureCount: '{count picture|pictures}', pictureAt: '{name}, {time} · {number} of {count}', previous: 'Previous picture', next: 'Next picture',
    noPictures: 'No pictures in this period', noPicturesHint: 'A picture appears here when a camera has sent one and it is stored.',
    around: 'Pictures', aroundOf: 'Pictures around {pair} at {time}',
  },

  // ------------------------------------------------------------------------------------------------------------------

  report: {
    title: 'Report of {mission}', reading: 'The report is being read …', none: 'Nothing to report yet', noneHint: 'The mission has not begun, or nothing is stored of it.', toMission: 'To the mission', again: 'Read again', print: 'Print or save as PDF',
    time: 'Time', length: 'Length', running: 'still running', ofFields: '{share} of {hectares}', map: 'Fields', mapLabel: 'Map of the fields with what was worked. {fields}',
    runs: 'Runs', countRuns: '{count run|runs}', late: 'Reports late by', lateHint: 'The analytics found its reports late: its clock or its connection is behind.',
    coverages: 'Worked area', encounters: 'Encounters', averages: 'Average temperatures', alarms: 'Alarms', markers: 'Notes', devices: 'Devices',
    no: { coverages: 'No worked area is known of that time.', encounters: 'No encounters are known of that time.', averages: 'No averages are known of that time.', alarms: 'No alarms are known of that time.', markers: 'No notes.', devices: 'No devices are known.' },
    alarmsRetained: 'Alarms are known until a day after they were closed.', more: '{shown} of {count} are shown. The CSV has all.', made: 'Made on {time} ({zone}) by Furrow.',
    field: 'Field', hectares: 'Worked', fieldHectares: 'Field area', share: 'Share', overlap: 'Worked again', gaps: 'Gaps', from: 'From', to: 'To', mean: 'Average', min: 'Lowest', max: 'Highest', windows: 'Windows', suspects: 'Suspects',
    when: 'When', severity: 'Severity', alarm: 'Alarm', times: 'Times', open: 'Open for', stillOpen: 'still open', note: 'Note', author: 'Who', device: 'Device', id: 'Id', type: 'Type', state: 'State',
  },

  // ------------------------------------------------------------------------------------------------------------------

  platform: {
    well: 'Everything is working', wrong: 'Needs a look', partDown: '{part} is {state}. {detail}', behind: '{group} is {lag record|records} behind', hasLetters: '{count record|records} could not be processed: set aside as dead letters',
    parts: 'Parts', partNames: { api: 'REST API', iotAgent: 'IoT Agent', kafka: 'Kafka' }, states: { up: 'up', down: 'down', dead: 'dead' },
    lag: 'Lag', lagHint: 'Records that a consumer group has not committed yet; jobs commit with each checkpoint.', noGroups: 'No consumer group has committed anything yet.', ofReplays: '{count group|groups} of replays without a lag',
    letters: 'Dead letters', noLetters: 'None in {count topic|topics}', lettersHint: 'Their headers describe the error and its place. When it is fixed, redrive them:', lettersCommand: 'Commands that redrive dead letters', notKnown: 'Not known while it does not answer.',
    hops: 'How long a report takes', hop: 'Hop', axis: 'On one axis', samples: '{count report|reports} of the last minute', hopsWait: 'Waiting for reports …',
    hopNames: { device: 'Device to Kafka', source: 'Kafka to domain', page: 'Domain to this page', all: 'Together' },
    hopsHint: 'By the times in the records’ headers: when the device measured, when the NGSI source received the report, when ingest had routed it, and when this page received it. The bright part is half of all reports, the faint ones are 95 and 99 of 100. Clocks that differ show as delay.',
  },
};

export const texts = language === 'en' ? english : (await import(`./texts.${language}.js`)).texts;

/**
 * The text of a key.
 *
 * @param {string} key `section.name`
 * @param {Object<string, *>=} values replace `{name}`
 */
export function t(key, values = {}) {
  const text = key.split('.').reduce((section, name) => (section && Object.hasOwn(section, name) ? section[name] : undefined), texts);
  if (typeof text !== 'string') {
    console.error(`no text ${key}`);
    return key;
  }
  return fill(text, values);
}

/** Why a request was rejected: the server's sentence, and before it one of the code if the language of the page is another. */
export function refusal(code, reason) {
  return texts.refusals && Object.hasOwn(texts.refusals, code) ? `${texts.refusals[code]}: ${reason}` : reason;
}

/** Replaces `{name}`, `{count one|more}` by the number and a word, and `{count: one|more}` by the word alone. */
export function fill(text, values) {
  const counted = text.replace(/\{(\w+)(:?) ([^|}]+)\|([^}]+)\}/g, (whole, name, alone, one, more) => `${alone ? '' : `{${name}} `}${String(values[name]) === '1' ? one : more}`);
  return counted.replace(/\{(\w+)\}/g, (whole, name) => (name in values ? String(values[name]) : whole));
}
