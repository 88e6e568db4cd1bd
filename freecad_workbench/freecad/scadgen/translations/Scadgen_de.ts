<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
 <context>
  <name>App::Property</name>
  <message>
   <source>A joint, or a frame</source>
   <translation>Ein Knoten oder ein Rahmen</translation>
  </message>
  <message>
   <source>Cells of the frame across</source>
   <translation>Zellen des Rahmens in der Breite</translation>
  </message>
  <message>
   <source>Cells of the frame up</source>
   <translation>Zellen des Rahmens in der Höhe</translation>
  </message>
  <message>
   <source>Density of the material, in g/cm3</source>
   <translation>Dichte des Materials in g/cm³</translation>
  </message>
  <message>
   <source>Distance between the centres of two joints</source>
   <translation>Abstand der Mitten zweier Knoten</translation>
  </message>
  <message>
   <source>Gap between mating faces</source>
   <translation>Spalt zwischen anliegenden Flächen</translation>
  </message>
  <message>
   <source>Gap between the peg and each wall of its socket</source>
   <translation>Spalt zwischen dem Zapfen und jeder Wand seiner Tasche</translation>
  </message>
  <message>
   <source>How far it is pulled apart, in sides</source>
   <translation>Wie weit er auseinandergezogen ist, in Seiten</translation>
  </message>
  <message>
   <source>How finely walls are cut up</source>
   <translation>Wie fein Wände zerlegt sind</translation>
  </message>
  <message>
   <source>Lead-in of the peg's tips</source>
   <translation>Fase an den Enden des Zapfens</translation>
  </message>
  <message>
   <source>Length of the peg</source>
   <translation>Länge des Zapfens</translation>
  </message>
  <message>
   <source>Mass of all pieces printed solid, in g</source>
   <translation>Masse aller Teile, voll gedruckt, in g</translation>
  </message>
  <message>
   <source>Mass of the part printed solid, in g</source>
   <translation>Masse des Teils, voll gedruckt, in g</translation>
  </message>
  <message>
   <source>Name in a bill of materials</source>
   <translation>Name in einer Stückliste</translation>
  </message>
  <message>
   <source>Number of pieces</source>
   <translation>Anzahl der Teile</translation>
  </message>
  <message>
   <source>Number of pieces of each part</source>
   <translation>Anzahl von jedem Teil</translation>
  </message>
  <message>
   <source>Number of pieces to print for the frame</source>
   <translation>Anzahl der Teile, die für den Rahmen zu drucken sind</translation>
  </message>
  <message>
   <source>Pegs fixed to tubes, or loose</source>
   <translation>Zapfen fest an den Rohren oder lose</translation>
  </message>
  <message>
   <source>Pieces that the kit's frame needs</source>
   <translation>Stückzahl, die der Rahmen des Bausatzes braucht</translation>
  </message>
  <message>
   <source>Side of the square bore along all edges</source>
   <translation>Seite der quadratischen Bohrung durch alle Kanten</translation>
  </message>
  <message>
   <source>Side of the square peg</source>
   <translation>Seite des quadratischen Zapfens</translation>
  </message>
  <message>
   <source>Side of the square tubes</source>
   <translation>Seite der quadratischen Rohre</translation>
  </message>
  <message>
   <source>The command that made the kit</source>
   <translation>Der Befehl, der den Bausatz erzeugt hat</translation>
  </message>
  <message>
   <source>The kit that the part belongs to</source>
   <translation>Der Bausatz, zu dem das Teil gehört</translation>
  </message>
  <message>
   <source>The kit whose parts stand here</source>
   <translation>Der Bausatz, dessen Teile hier stehen</translation>
  </message>
  <message>
   <source>The text of kit.json</source>
   <translation>Der Text von kit.json</translation>
  </message>
  <message>
   <source>Version of these properties</source>
   <translation>Version dieser Eigenschaften</translation>
  </message>
  <message>
   <source>Volume of all pieces</source>
   <translation>Volumen aller Teile</translation>
  </message>
  <message>
   <source>Volume of the part</source>
   <translation>Volumen des Teils</translation>
  </message>
  <message>
   <source>What the kit's files are called</source>
   <translation>Wie die Dateien des Bausatzes heißen</translation>
  </message>
  <message>
   <source>What the shape was made of</source>
   <translation>Woraus die Form entstanden ist</translation>
  </message>
  <message>
   <source>Which kind of joint</source>
   <translation>Welche Art von Knoten</translation>
  </message>
  <message>
   <source>Which part of the kit it is</source>
   <translation>Welches Teil des Bausatzes es ist</translation>
  </message>
 </context>
 <context>
  <name>Scadgen</name>
  <message>
   <source>Angle</source>
   <translation>Winkel</translation>
  </message>
  <message>
   <source>As it stands in the document, at its own values</source>
   <translation>So, wie es im Dokument steht, mit seinen eigenen Werten</translation>
  </message>
  <message>
   <source>Basic element</source>
   <translation>Grundelement</translation>
  </message>
  <message>
   <source>Bay length</source>
   <translation>Feldlänge</translation>
  </message>
  <message>
   <source>Bays</source>
   <translation>Felder</translation>
  </message>
  <message>
   <source>Centre</source>
   <translation>Mitte auf 0</translation>
  </message>
  <message>
   <source>Check</source>
   <translation>Prüfen</translation>
  </message>
  <message>
   <source>Choose the file that the frame is in</source>
   <translation>Die Datei wählen, in der der Rahmen ist</translation>
  </message>
  <message>
   <source>Columns</source>
   <translation>Spalten</translation>
  </message>
  <message>
   <source>Components</source>
   <translation>Mehrere Teile</translation>
  </message>
  <message>
   <source>Connector</source>
   <translation>Verbinder</translation>
  </message>
  <message>
   <source>Connectors</source>
   <translation>Verbinder</translation>
  </message>
  <message>
   <source>Edge element</source>
   <translation>Kantenelement</translation>
  </message>
  <message>
   <source>Elements along the rows</source>
   <translation>Elemente entlang der Reihen</translation>
  </message>
  <message>
   <source>Elements between the rows</source>
   <translation>Elemente zwischen den Reihen</translation>
  </message>
  <message>
   <source>Every piece laid out on beds of {:g} x {:g} mm, and a bill of materials</source>
   <translation>Jedes Teil auf Druckbetten von {:g} x {:g} mm ausgelegt, und eine Stückliste</translation>
  </message>
  <message>
   <source>FAILED</source>
   <translation>FEHLER</translation>
  </message>
  <message>
   <source>Flatten</source>
   <translation>Kurven</translation>
  </message>
  <message>
   <source>Follow the kit</source>
   <translation>Dem Bausatz folgen</translation>
  </message>
  <message>
   <source>Found</source>
   <translation>Gefunden</translation>
  </message>
  <message>
   <source>Frame</source>
   <translation>Rahmen</translation>
  </message>
  <message>
   <source>From a file</source>
   <translation>Aus einer Datei</translation>
  </message>
  <message>
   <source>Give it a clearance of its own</source>
   <translation>Eigenes Spiel geben</translation>
  </message>
  <message>
   <source>Half</source>
   <translation>Hälfte</translation>
  </message>
  <message>
   <source>Halves A</source>
   <translation>Hälften A</translation>
  </message>
  <message>
   <source>Halves B</source>
   <translation>Hälften B</translation>
  </message>
  <message>
   <source>Height</source>
   <translation>Höhe</translation>
  </message>
  <message>
   <source>Joint</source>
   <translation>Knoten</translation>
  </message>
  <message>
   <source>Kit: {}</source>
   <translation>Bausatz: {}</translation>
  </message>
  <message>
   <source>Kits (*.json)</source>
   <translation>Bausätze (*.json)</translation>
  </message>
  <message>
   <source>Let it follow its kit again</source>
   <translation>Wieder dem Bausatz folgen lassen</translation>
  </message>
  <message>
   <source>Most</source>
   <translation>Höchstens</translation>
  </message>
  <message>
   <source>Must be</source>
   <translation>Soll</translation>
  </message>
  <message>
   <source>New kit</source>
   <translation>Neuer Bausatz</translation>
  </message>
  <message>
   <source>No split</source>
   <translation>Nicht teilen</translation>
  </message>
  <message>
   <source>One file a part with its count in the name, and a bill of materials</source>
   <translation>Eine Datei je Teil mit der Stückzahl im Namen, und eine Stückliste</translation>
  </message>
  <message>
   <source>One-sided element</source>
   <translation>Einseitiges Element</translation>
  </message>
  <message>
   <source>Open kit</source>
   <translation>Bausatz öffnen</translation>
  </message>
  <message>
   <source>Outline</source>
   <translation>Umriss</translation>
  </message>
  <message>
   <source>Own clearance</source>
   <translation>Eigenes Spiel</translation>
  </message>
  <message>
   <source>Parts</source>
   <translation>Teile</translation>
  </message>
  <message>
   <source>Peg</source>
   <translation>Zapfen</translation>
  </message>
  <message>
   <source>Pegs</source>
   <translation>Zapfen</translation>
  </message>
  <message>
   <source>Pull apart</source>
   <translation>Auseinanderziehen</translation>
  </message>
  <message>
   <source>Radius</source>
   <translation>Radius</translation>
  </message>
  <message>
   <source>Repair</source>
   <translation>Reparieren</translation>
  </message>
  <message>
   <source>Restore</source>
   <translation>Wiederherstellen</translation>
  </message>
  <message>
   <source>Rows</source>
   <translation>Reihen</translation>
  </message>
  <message>
   <source>Scale</source>
   <translation>Maßstab</translation>
  </message>
  <message>
   <source>Shortest</source>
   <translation>Kürzeste</translation>
  </message>
  <message>
   <source>Sides</source>
   <translation>Seiten</translation>
  </message>
  <message>
   <source>Snap</source>
   <translation>Einrasten</translation>
  </message>
  <message>
   <source>Stopped; nothing was made</source>
   <translation>Angehalten; nichts wurde erzeugt</translation>
  </message>
  <message>
   <source>Stopping</source>
   <translation>Wird angehalten</translation>
  </message>
  <message>
   <source>Strict</source>
   <translation>Streng</translation>
  </message>
  <message>
   <source>The engine is at work</source>
   <translation>Der Rechenkern arbeitet</translation>
  </message>
  <message>
   <source>The kit was deleted meanwhile</source>
   <translation>Der Bausatz wurde inzwischen gelöscht</translation>
  </message>
  <message>
   <source>Tolerance</source>
   <translation>Toleranz</translation>
  </message>
  <message>
   <source>Triangles</source>
   <translation>Dreiecke</translation>
  </message>
  <message>
   <source>Tube</source>
   <translation>Rohr</translation>
  </message>
  <message>
   <source>Two-sided element</source>
   <translation>Zweiseitiges Element</translation>
  </message>
  <message>
   <source>Unit</source>
   <translation>Einheit</translation>
  </message>
  <message>
   <source>Width</source>
   <translation>Breite</translation>
  </message>
  <message>
   <source>Written to {}: {}</source>
   <translation>Nach {} geschrieben: {}</translation>
  </message>
  <message>
   <source>another</source>
   <translation>ein anderes</translation>
  </message>
  <message>
   <source>in range</source>
   <translation>im Bereich</translation>
  </message>
  <message>
   <source>ok</source>
   <translation>gut</translation>
  </message>
  <message>
   <source>say where it is under Edit &gt; Preferences &gt; Scadgen</source>
   <translation>geben Sie unter Bearbeiten &gt; Einstellungen &gt; Scadgen an, wo es ist</translation>
  </message>
  <message>
   <source>scadgen check gave no results: try it at a terminal</source>
   <translation>scadgen check lieferte keine Ergebnisse: am Terminal ausprobieren</translation>
  </message>
  <message>
   <source>scadgen frame gave no list: try it at a terminal</source>
   <translation>scadgen frame lieferte keine Liste: am Terminal ausprobieren</translation>
  </message>
  <message>
   <source>scadgen was killed or crashed midway; nothing was made: try again</source>
   <translation>scadgen wurde mittendrin beendet oder ist abgestürzt; nichts wurde erzeugt: versuchen Sie es noch einmal</translation>
  </message>
  <message>
   <source>scadgen: not found; install it as this workbench's README says, or {}</source>
   <translation>scadgen: nicht gefunden; installieren Sie es wie im README dieses Arbeitsbereichs, oder {}</translation>
  </message>
  <message>
   <source>second shape</source>
   <translation>zweite Form</translation>
  </message>
  <message>
   <source>the same</source>
   <translation>dasselbe</translation>
  </message>
  <message>
   <source>{:.1f} sides, {:.1f} mm</source>
   <translation>{:.1f} Seiten, {:.1f} mm</translation>
  </message>
  <message>
   <source>{} has the shape that its values make</source>
   <translation>{} hat die Form, die seine Werte ergeben</translation>
  </message>
  <message>
   <source>{} is in its ranges</source>
   <translation>{} ist in seinen Bereichen</translation>
  </message>
  <message>
   <source>{} is not scadgen (it said {!r}); {}</source>
   <translation>{} ist nicht scadgen (Ausgabe: {!r}); {}</translation>
  </message>
  <message>
   <source>{} is scadgen {}, this workbench needs {}: install that one, or {}</source>
   <translation>{} ist scadgen {}, dieser Arbeitsbereich braucht {}: installieren Sie dieses, oder {}</translation>
  </message>
  <message>
   <source>{} is what the engine makes</source>
   <translation>{} ist, was der Rechenkern erzeugt</translation>
  </message>
  <message>
   <source>{} left with status {} and said nothing; {}</source>
   <translation>{} endete mit Status {} und ohne ein Wort; {}</translation>
  </message>
  <message>
   <source>{} objects have their behaviour back</source>
   <translation>{} Objekte haben ihr Verhalten wieder</translation>
  </message>
  <message>
   <source>{} of {} checks are good</source>
   <translation>{} von {} Prüfungen sind gut</translation>
  </message>
  <message>
   <source>{}: cannot be started; {}</source>
   <translation>{}: lässt sich nicht starten; {}</translation>
  </message>
  <message>
   <source>{}: no such program; {}</source>
   <translation>{}: kein solches Programm; {}</translation>
  </message>
 </context>
 <context>
  <name>ScadgenCheck</name>
  <message>
   <source>Check</source>
   <translation>Prüfen</translation>
  </message>
  <message>
   <source>Choose a line to select the part that it is about</source>
   <translation>Eine Zeile wählt das Teil aus, um das es geht</translation>
  </message>
 </context>
 <context>
  <name>ScadgenChoose</name>
  <message>
   <source>What to add; Ctrl and Shift choose several</source>
   <translation>Was hinzugefügt wird; mit Strg und Umschalt mehreres</translation>
  </message>
 </context>
 <context>
  <name>ScadgenExplode</name>
  <message>
   <source>How far the pieces draw apart</source>
   <translation>Wie weit die Teile auseinanderrücken</translation>
  </message>
  <message>
   <source>Pull apart</source>
   <translation>Auseinanderziehen</translation>
  </message>
 </context>
 <context>
  <name>ScadgenExport</name>
  <message>
   <source>3MF</source>
   <translation>3MF</translation>
  </message>
  <message>
   <source>All that the kit needs, with counts</source>
   <translation>Alles, was der Bausatz braucht, mit Stückzahlen</translation>
  </message>
  <message>
   <source>Export</source>
   <translation>Exportieren</translation>
  </message>
  <message>
   <source>Folder</source>
   <translation>Ordner</translation>
  </message>
  <message>
   <source>Format</source>
   <translation>Format</translation>
  </message>
  <message>
   <source>STEP</source>
   <translation>STEP</translation>
  </message>
  <message>
   <source>STEP for CAD, STL and 3MF for printing</source>
   <translation>STEP für CAD, STL und 3MF zum Drucken</translation>
  </message>
  <message>
   <source>STL</source>
   <translation>STL</translation>
  </message>
  <message>
   <source>What is selected</source>
   <translation>Was ausgewählt ist</translation>
  </message>
  <message>
   <source>Where the files go; those of the same names are replaced</source>
   <translation>Wohin die Dateien kommen; gleichnamige werden ersetzt</translation>
  </message>
 </context>
 <context>
  <name>ScadgenNewKit</name>
  <message>
   <source>A joint</source>
   <translation>Einen Knoten</translation>
  </message>
  <message>
   <source>A named frame, or one from a file</source>
   <translation>Ein Rahmen mit Namen oder einer aus einer Datei</translation>
  </message>
  <message>
   <source>Bore</source>
   <translation>Bohrung</translation>
  </message>
  <message>
   <source>Clearance</source>
   <translation>Spiel</translation>
  </message>
  <message>
   <source>Detail</source>
   <translation>Feinheit</translation>
  </message>
  <message>
   <source>Distance between the centres of two joints</source>
   <translation>Abstand der Mitten zweier Knoten</translation>
  </message>
  <message>
   <source>Draft</source>
   <translation>Entwurf</translation>
  </message>
  <message>
   <source>Drawing, mesh or JSON file with the frame's edges</source>
   <translation>Zeichnung, Netz oder JSON-Datei mit den Kanten des Rahmens</translation>
  </message>
  <message>
   <source>Edge length</source>
   <translation>Kantenlänge</translation>
  </message>
  <message>
   <source>Fine</source>
   <translation>Fein</translation>
  </message>
  <message>
   <source>Frame</source>
   <translation>Rahmen</translation>
  </message>
  <message>
   <source>From a file</source>
   <translation>Aus einer Datei</translation>
  </message>
  <message>
   <source>Gap between mating faces</source>
   <translation>Spalt zwischen anliegenden Flächen</translation>
  </message>
  <message>
   <source>Gap between the peg and each wall of its socket</source>
   <translation>Spalt zwischen dem Zapfen und jeder Wand seiner Tasche</translation>
  </message>
  <message>
   <source>How finely curved walls are cut into flat faces</source>
   <translation>Wie fein gekrümmte Wände in ebene Flächen zerlegt werden</translation>
  </message>
  <message>
   <source>JSON file with ring_ratio, span, amplitude, bend and periods</source>
   <translation>JSON-Datei mit ring_ratio, span, amplitude, bend und periods</translation>
  </message>
  <message>
   <source>Lead-in of the peg's tips</source>
   <translation>Fase an den Enden des Zapfens</translation>
  </message>
  <message>
   <source>Length of the peg</source>
   <translation>Länge des Zapfens</translation>
  </message>
  <message>
   <source>Lengths (without a tick: what fits)</source>
   <translation>Längen (ohne Haken: was passt)</translation>
  </message>
  <message>
   <source>Loose pegs are put in from the ring's hole</source>
   <translation>Lose Zapfen werden vom Loch des Rings her eingesetzt</translation>
  </message>
  <message>
   <source>Loose pieces</source>
   <translation>Lose Teile</translation>
  </message>
  <message>
   <source>New kit</source>
   <translation>Neuer Bausatz</translation>
  </message>
  <message>
   <source>Nothing yet</source>
   <translation>Noch nichts</translation>
  </message>
  <message>
   <source>Part of the tubes</source>
   <translation>Teil der Rohre</translation>
  </message>
  <message>
   <source>Peg chamfer</source>
   <translation>Zapfenfase</translation>
  </message>
  <message>
   <source>Peg clearance</source>
   <translation>Zapfenspiel</translation>
  </message>
  <message>
   <source>Peg length</source>
   <translation>Zapfenlänge</translation>
  </message>
  <message>
   <source>Peg width</source>
   <translation>Zapfenbreite</translation>
  </message>
  <message>
   <source>Pegs</source>
   <translation>Zapfen</translation>
  </message>
  <message>
   <source>Prove that the joint locks</source>
   <translation>Beweisen, dass der Knoten hält</translation>
  </message>
  <message>
   <source>Side</source>
   <translation>Seite</translation>
  </message>
  <message>
   <source>Side of the square bore along all edges; without a tick there is none</source>
   <translation>Seite einer quadratischen Bohrung durch alle Kanten; ohne Haken gibt es keine</translation>
  </message>
  <message>
   <source>Side of the square peg</source>
   <translation>Seite des quadratischen Zapfens</translation>
  </message>
  <message>
   <source>Side of the square tubes</source>
   <translation>Seite der quadratischen Rohre</translation>
  </message>
  <message>
   <source>Standard</source>
   <translation>Normal</translation>
  </message>
  <message>
   <source>Takes longer; a kit that does not lock is refused</source>
   <translation>Dauert länger; ein Bausatz, der nicht hält, wird abgelehnt</translation>
  </message>
  <message>
   <source>The curves that the connectors grow around</source>
   <translation>Die Kurven, um die die Verbinder wachsen</translation>
  </message>
  <message>
   <source>The frame</source>
   <translation>Den Rahmen</translation>
  </message>
  <message>
   <source>The frame's own</source>
   <translation>Die des Rahmens</translation>
  </message>
  <message>
   <source>Then show</source>
   <translation>Danach zeigen</translation>
  </message>
  <message>
   <source>Weave</source>
   <translation>Geflecht</translation>
  </message>
  <message>
   <source>What fits the frame</source>
   <translation>Was zum Rahmen passt</translation>
  </message>
  <message>
   <source>What to add to the document besides the kit</source>
   <translation>Was außer dem Bausatz ins Dokument kommt</translation>
  </message>
 </context>
 <context>
  <name>ScadgenPreferences</name>
  <message>
   <source>3MF files of a whole kit are laid out on it</source>
   <translation>3MF-Dateien eines ganzen Bausatzes werden darauf ausgelegt</translation>
  </message>
  <message>
   <source>Clearance</source>
   <translation>Spiel</translation>
  </message>
  <message>
   <source>Density</source>
   <translation>Dichte</translation>
  </message>
  <message>
   <source>Depth</source>
   <translation>Tiefe</translation>
  </message>
  <message>
   <source>Empty: the one beside this workbench, or the one on the path</source>
   <translation>Leer: das neben diesem Arbeitsbereich oder das im Suchpfad</translation>
  </message>
  <message>
   <source>Engine</source>
   <translation>Rechenkern</translation>
  </message>
  <message>
   <source>Gap between mating faces</source>
   <translation>Spalt zwischen anliegenden Flächen</translation>
  </message>
  <message>
   <source>General</source>
   <translation>Allgemein</translation>
  </message>
  <message>
   <source>New kits</source>
   <translation>Neue Bausätze</translation>
  </message>
  <message>
   <source>Of the material that is printed: 1.24 is PLA</source>
   <translation>Des gedruckten Materials: 1,24 ist PLA</translation>
  </message>
  <message>
   <source>Printer's bed</source>
   <translation>Druckbett</translation>
  </message>
  <message>
   <source>The scadgen program</source>
   <translation>Das Programm scadgen</translation>
  </message>
  <message>
   <source>Width</source>
   <translation>Breite</translation>
  </message>
 </context>
 <context>
  <name>Scadgen_Check</name>
  <message>
   <source>Check</source>
   <translation>Prüfen</translation>
  </message>
  <message>
   <source>Check all that is known about the kit at its present values</source>
   <translation>Alles prüfen, was über den Bausatz mit seinen jetzigen Werten bekannt ist</translation>
  </message>
 </context>
 <context>
  <name>Scadgen_Explode</name>
  <message>
   <source>Explode</source>
   <translation>Auseinanderziehen</translation>
  </message>
  <message>
   <source>Pull a joint or a frame apart to see how it goes together</source>
   <translation>Einen Knoten oder Rahmen auseinanderziehen, um zu sehen, wie er zusammengehört</translation>
  </message>
 </context>
 <context>
  <name>Scadgen_Export</name>
  <message>
   <source>Export</source>
   <translation>Exportieren</translation>
  </message>
  <message>
   <source>Write what is selected or the whole kit as STEP, STL or 3MF</source>
   <translation>Ausgewähltes oder den ganzen Bausatz als STEP, STL oder 3MF schreiben</translation>
  </message>
 </context>
 <context>
  <name>Scadgen_Frame</name>
  <message>
   <source>Add the assembled frame; its rows and columns are properties</source>
   <translation>Den fertigen Rahmen hinzufügen; Reihen und Spalten sind seine Eigenschaften</translation>
  </message>
  <message>
   <source>Frame</source>
   <translation>Rahmen</translation>
  </message>
 </context>
 <context>
  <name>Scadgen_Joint</name>
  <message>
   <source>Add one assembled joint</source>
   <translation>Einen fertigen Knoten hinzufügen</translation>
  </message>
  <message>
   <source>Joint</source>
   <translation>Knoten</translation>
  </message>
 </context>
 <context>
  <name>Scadgen_NewKit</name>
  <message>
   <source>Make the parts of a frame that locks without glue or screws</source>
   <translation>Die Teile eines Rahmens erzeugen, der ohne Leim und Schrauben hält</translation>
  </message>
  <message>
   <source>New kit</source>
   <translation>Neuer Bausatz</translation>
  </message>
 </context>
 <context>
  <name>Scadgen_OpenKit</name>
  <message>
   <source>Open kit</source>
   <translation>Bausatz öffnen</translation>
  </message>
  <message>
   <source>Take the kit.json that scadgen wrote into the document</source>
   <translation>Die von scadgen geschriebene kit.json ins Dokument übernehmen</translation>
  </message>
 </context>
 <context>
  <name>Scadgen_Part</name>
  <message>
   <source>Add parts of the kit</source>
   <translation>Teile des Bausatzes hinzufügen</translation>
  </message>
  <message>
   <source>Part</source>
   <translation>Teil</translation>
  </message>
 </context>
 <context>
  <name>Scadgen_Preferences</name>
  <message>
   <source>Preferences</source>
   <translation>Einstellungen</translation>
  </message>
  <message>
   <source>Where the engine is, new kits' clearance, printer's bed</source>
   <translation>Wo der Rechenkern ist, Spiel neuer Bausätze, Druckbett</translation>
  </message>
 </context>
 <context>
  <name>Scadgen_Restore</name>
  <message>
   <source>Give parts back their behaviour that were saved without this workbench</source>
   <translation>Teilen ihr Verhalten zurückgeben, die ohne diesen Arbeitsbereich gespeichert wurden</translation>
  </message>
  <message>
   <source>Restore</source>
   <translation>Wiederherstellen</translation>
  </message>
 </context>
 <context>
  <name>Workbench</name>
  <message>
   <source>Scadgen</source>
   <translation>Scadgen</translation>
  </message>
  <message>
   <source>Trusses that interlock without glue or screws</source>
   <translation>Fachwerke, die ohne Leim und Schrauben ineinandergreifen</translation>
  </message>
 </context>
</TS>
